// Random numbers of a path, and the weights of its two strategies to find light.
// Options: PRELIGHT_LIGHTS_ONLY, PRELIGHT_SCATTER_ONLY: use only one of the two (for tests; whitted finds lights only
// by sampling them).
#ifndef PRELIGHT_REFERENCE_PATH_FUNCS_CL
#define PRELIGHT_REFERENCE_PATH_FUNCS_CL

#include "shared/reference_types.h"
#include "transport/light_funcs.cl"
#include "transport/mis_funcs.cl"

// Coordinate pairs of a path's point: one for the position in the pixel, then these for every vertex.
#define PRELIGHT_PAIR_PIXEL 0u
#define PRELIGHT_PAIR_LOBE 1u       // lobe, roulette
#define PRELIGHT_PAIR_DIRECTION 2u
#define PRELIGHT_PAIR_LIGHT 3u      // group, emitter
#define PRELIGHT_PAIR_PLACE 4u      // on the emitter, in the sky
#define PRELIGHT_PAIRS_A_VERTEX 4u
#define PRELIGHT_PAIR_CANDIDATE 0x20000u  // first pair beyond those of all vertices
#define PRELIGHT_PAIR_LENS 0x80000u

// Returns sample i of `count` that a path draws from one pair. All samples of a pixel together are as evenly
// distributed as one per path.
uint2 finerPathBits(__constant const ReferenceParameters* p, uint path, uint pair, uint count, uint i) {
  const uint pixel = p->firstPixel + path / p->samplesPerPass;
  const uint seed = hashInteger(pixel + hashInteger(p->pass + hashInteger(p->seed)));
  return samplePaddedBits((path % p->samplesPerPass) * count + i, hashInteger(seed + pair * 0x9e3779b9u));
}

uint2 pathBits(__constant const ReferenceParameters* p, uint path, uint pair) {
  return finerPathBits(p, path, pair, 1u, 0u);
}

float2 pathPoint(__constant const ReferenceParameters* p, uint path, uint pair) {
  const uint2 bits = pathBits(p, path, pair);
  return (float2)(unitFloat(bits.x), unitFloat(bits.y));
}

#endif
