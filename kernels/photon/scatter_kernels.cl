// Photons at the surfaces that they meet: they are stored, absorbed or scattered. docs/photons.md states the classes of
// paths.
// Options: those of the included files; PRELIGHT_ABSORPTION (some glass absorbs); PRELIGHT_CAUSTICS (photons of the
// caustic map, which follow only mirrors, glass and narrow lobes and end on the first surface that scatters diffusely);
// PRELIGHT_SHARP_CAUSTICS, in addition (only mirrors and smooth glass are followed, onto all surfaces that scatter
// otherwise); PRELIGHT_STORE_DIRECT (photons that come directly from their light are stored as well);
// PRELIGHT_STORE_EMITTED (those that come directly from emissive triangles are).
#include "core/octahedral_funcs.cl"
#include "photon/path_funcs.cl"
#include "shared/photon_types.h"
#include "transport/dispersion_funcs.cl"
#include "transport/material_funcs.cl"
#include "transport/medium_funcs.cl"
#include "transport/roulette_funcs.cl"
#include "transport/scene_funcs.cl"
#include "transport/straight_funcs.cl"

// Light that is trapped between mirrors or in glass loses nothing and would not end. After this number of such surfaces
// in a row Russian roulette ends it, too.
#define PRELIGHT_CAUGHT_AFTER 48u
#define PRELIGHT_CAUGHT_SURVIVAL 0.75f

// Photons in a closed white room would not end either, and each of their hits is stored. After this many surfaces Russian
// roulette thins them, slowly enough that light of paths ten times as long is still found.
#define PRELIGHT_LONG_AFTER 64u
#define PRELIGHT_LONG_SURVIVAL 0.98f

// Returns the lobes by which a photon may go on; with rough glass each lobe apart, so that the photon knows by which
// one it went.
PRELIGHT_INLINE uint lobesOf(Bsdf b) {
#if defined(PRELIGHT_SHARP_CAUSTICS)
#ifdef PRELIGHT_ROUGH_GLASS
  if (isRoughGlass(b)) return PRELIGHT_LOBE_MIRROR | PRELIGHT_LOBES_APART;
#endif
  return PRELIGHT_LOBES_SPECULAR | PRELIGHT_LOBES_APART;
#elif defined(PRELIGHT_CAUSTICS)
  return narrowLobes(b) | PRELIGHT_LOBES_APART;
#else
  return PRELIGHT_LOBES_ALL | PRELIGHT_LOBES_APART;
#endif
}

// Returns PRELIGHT_SCATTERED_* for a lobe of a surface. Light that passes straight through a pane is not scattered: it
// is still direct light.
PRELIGHT_INLINE uint scatteredBy(Interaction i, uint lobe, Bsdf b) {
  if (goesStraight(i, b, lobe)) return 0u;
  return (lobe & narrowLobes(b)) != 0u ? PRELIGHT_SCATTERED_SPECULAR : PRELIGHT_SCATTERED_WIDELY;
}

PRELIGHT_INLINE bool storesHere(__constant const PhotonParameters* p, PhotonPath path, Bsdf b) {
#ifdef PRELIGHT_SHARP_CAUSTICS
  return path.scattered != 0u && (isDiffuse(b) || isGlossy(b));
#endif
  if (!isDiffuse(b)) return false;
#ifdef PRELIGHT_CAUSTICS
  return path.scattered == PRELIGHT_SCATTERED_SPECULAR;
#elif defined(PRELIGHT_STORE_DIRECT)
  return true;
#elif defined(PRELIGHT_STORE_EMITTED)
  return path.scattered != 0u || p->source.kind == PRELIGHT_SOURCE_EMITTERS;
#else
  return path.scattered != 0u;
#endif
}

PRELIGHT_INLINE bool goesOnFrom(PhotonPath path, Bsdf b) {
#if defined(PRELIGHT_CAUSTICS) && !defined(PRELIGHT_SHARP_CAUSTICS)
  return path.scattered == 0u || !isDiffuse(b);
#else
  return true;
#endif
}

// Returns the share of a photon's power that is left at `place`, after `way` metres without scattering, by the range
// window of KHR_lights_punctual.
PRELIGHT_INLINE float leftInRange(__constant const PhotonParameters* p, Lights lights, uint depth, PhotonPath path, float way,
                                  float3 place) {
#ifdef PRELIGHT_PUNCTUAL
  if (p->source.kind != PRELIGHT_SOURCE_PUNCTUAL || path.scattered != 0u) return 1.0f;
  __global const PunctualLight* light = lights.punctual + p->source.light;
  if (depth > 0u) way = length(place - vload3(0, light->position));  // the photon has passed panes
  const float ratio = way * light->inverseRange;
  return clamp(1.0f - ratio * ratio * ratio * ratio, 0.0f, 1.0f);
#else
  return 1.0f;
#endif
}

// Draws the direction in which a photon that arrives with `power` goes on. Returns false when it is absorbed.
PRELIGHT_INLINE bool scatterPhoton(__constant const PhotonParameters* p, uint depth, PathScene s, Interaction surface, Bsdf bsdf,
                                   float3 power, PhotonPath* path, __global Ray* next) {
  const uint pair = PRELIGHT_PAIR_FIRST_SURFACE + depth * PRELIGHT_PAIRS_A_SURFACE;
  const float2 chance = photonPoint(p, path->photon, pair + PRELIGHT_PAIR_LOBE);
  const float2 u = photonPoint(p, path->photon, pair + PRELIGHT_PAIR_DIRECTION);
#ifdef PRELIGHT_DISPERSION
  const float wave = photonPoint(p, path->photon, PRELIGHT_PAIR_WAVELENGTH).x;
  disperse(s, surface, wave, path->dispersed != 0u, &bsdf);
#endif
  BsdfSample sample;
  if (!sampleBsdf(surface, bsdf, lobesOf(bsdf), PRELIGHT_IMPORTANCE, chance.x, u, &sample)) return false;
  const uint scattered = scatteredBy(surface, sample.lobe, bsdf);
  float3 leaving = carriedBy(sample, power);
#ifdef PRELIGHT_DISPERSION
  if (path->dispersed == 0u && takesColor(s, surface, bsdf, sample.lobe)) {
    leaving *= colorOfWave(wave);
    path->dispersed = 1u;
  }
#endif
  if (scattered != 0u) path->mirrored = scattered == PRELIGHT_SCATTERED_SPECULAR ? path->mirrored + 1u : 0u;
  float survival = depth < p->rouletteDepth ? 1.0f : fmin(largest(leaving) / largest(power), 1.0f);
  if (path->mirrored > PRELIGHT_CAUGHT_AFTER) survival = fmin(survival, PRELIGHT_CAUGHT_SURVIVAL);
  if (depth > PRELIGHT_LONG_AFTER) survival = fmin(survival, PRELIGHT_LONG_SURVIVAL);
  if (!(largest(leaving) > 0.0f) || !survives(survival, chance.y, &leaving)) return false;
  vstore3(leaving, 0, path->power);
  path->medium = mediumAfter(surface, sample.lobe, path->medium);
  path->scattered |= scattered;
  *next = rayFrom(surface, normalize(sample.direction), MAXFLOAT);
  return true;
}

void countPower(__constant const PhotonParameters* p, const float* power, float sign, long* counts) {
  for (uint c = 0; c < 3; ++c) counts[c] += (sign < 0.0f ? -1 : 1) * countsOf(p, power[c]);
}

// One work-item per travelling photon. rays, hits, queue [count] -> outcomes [count], PRELIGHT_PHOTON_*; rays from
// step.next on where photons go on; stored [count] where they are stored; tallies [count][6]: absorbed and escaped
// power, in counts. Next: sumTallies; marked photons are listed and compacted.
__kernel void scatterPhotons(__constant const PhotonParameters* p, const PhotonStep step,
                             __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                             __global const LightLine* lightLines, __global Ray* rays, __global const Hit* hits,
                             __global const uint* queue, __global PhotonPath* paths, __global uchar* outcomes,
                             __global Photon* stored, __global long* tallies) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  const Scene scene = sceneOf(&p->scene, surfaceLines, shadingLines, lightLines);
  const PathScene s = scene.surface;
  PhotonPath path = paths[queue[i]];
  const Hit hit = hits[i];
  long absorbed[3] = {0, 0, 0}, escaped[3] = {0, 0, 0};
  uchar outcome = 0;
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) {
    countPower(p, path.power, 1.0f, escaped);
  } else {
    countPower(p, path.power, 1.0f, absorbed);
    const Interaction surface = loadInteraction(s, rays[i], hit);
    const Bsdf bsdf = loadBsdf(s, surface);
    float3 power = vload3(0, path.power);
    const float inRange = leftInRange(p, scene.lights, step.depth, path, hit.t, surface.position);
    power *= inRange;
#ifdef PRELIGHT_ABSORPTION
    const uint medium = mediumBefore(surface, path.medium);
    if (medium != PRELIGHT_NO_MEDIUM) power *= unabsorbed(s, medium, hit.t);
#endif
    if (!surface.front && (surface.flags & PRELIGHT_DOUBLE_SIDED) == 0u && largest(bsdf.diffuse) > 0.0f)
      outcome |= PRELIGHT_PHOTON_MET_BACK;
    if (storesHere(p, path, bsdf)) {
      Photon photon;
      vstore3(surface.position, 0, photon.position);
      photon.triangle = hit.triangle;
      vstore3(power, 0, photon.power);
      photon.direction = packDirection(surface.wo);
      stored[i] = photon;
      outcome |= PRELIGHT_PHOTON_STORED;
    }
    if (goesOnFrom(path, bsdf) && scatterPhoton(p, step.depth, s, surface, bsdf, power, &path, rays + step.next + i)) {
      // The range window is applied anew at the next surface.
      if (path.scattered == 0u) vstore3(vload3(0, path.power) / inRange, 0, path.power);
      paths[queue[i]] = path;
      countPower(p, path.power, -1.0f, absorbed);
      outcome |= PRELIGHT_PHOTON_GOES_ON;
    }
  }
  outcomes[i] = outcome;
  for (uint c = 0; c < 3; ++c) {
    tallies[6 * i + c] = absorbed[c];
    tallies[6 * i + 3 + c] = escaped[c];
  }
}

// One work-item per run and column. tallies [count][columns] -> sums [run][columns], each over `run` tallies.
__kernel void sumTallies(const uint count, const uint columns, const uint run, __global const long* tallies,
                         __global long* sums) {
  const size_t group = get_global_id(0) / columns, column = get_global_id(0) % columns;
  if (group * run >= count) return;
  long sum = 0;
  for (size_t i = group * run; i < min((size_t)count, (group + 1) * run); ++i) sum += tallies[i * columns + column];
  sums[get_global_id(0)] = sum;
}
