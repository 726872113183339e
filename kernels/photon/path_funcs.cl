// Random numbers of a photon, and its power in counts.
#ifndef PRELIGHT_PHOTON_PATH_FUNCS_CL
#define PRELIGHT_PHOTON_PATH_FUNCS_CL

#include "core/sampling_funcs.cl"
#include "shared/photon_path_types.h"

// Coordinate pairs of a photon's point after the pair of its direction; PLACE and EMITTER occur once, LOBE and
// DIRECTION for every surface that it meets.
#define PRELIGHT_PAIR_PLACE 1u
#define PRELIGHT_PAIR_EMITTER 2u
#define PRELIGHT_PAIR_FIRST_SURFACE 3u
#define PRELIGHT_PAIR_LOBE 0u       // lobe, roulette
#define PRELIGHT_PAIR_DIRECTION 1u
#define PRELIGHT_PAIRS_A_SURFACE 2u

uint2 photonBits(__constant const PhotonParameters* p, uint photon, uint pair) {
  return samplePaddedBits(photon, hashInteger(p->source.seed + pair * 0x9e3779b9u));
}

float2 photonPoint(__constant const PhotonParameters* p, uint photon, uint pair) {
  const uint2 bits = photonBits(p, photon, pair);
  return (float2)(unitFloat(bits.x), unitFloat(bits.y));
}

long countsOf(__constant const PhotonParameters* p, float power) { return convert_long_rte(power / p->unit); }

#endif
