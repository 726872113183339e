// What photons do where they arrive: be stored, be absorbed, go on. docs/photons.md states the classes of paths.
// Options: those of the included files, PRELIGHT_ABSORPTION (some glass absorbs); PRELIGHT_CAUSTICS: photons of the caustic
// map, which follow mirrors, glass and narrow lobes alone and end on the first surface that scatters diffusely;
// PRELIGHT_STORE_DIRECT: those that come straight from their light are stored as well.
#include "core/octahedral_funcs.cl"
#include "photon/adjoint_funcs.cl"
#include "photon/path_funcs.cl"
#include "shade/lobe_class_funcs.cl"
#include "shade/scene_funcs.cl"
#include "shared/photon_types.h"

// Light that is caught between mirrors or in glass loses nothing and would not end. From so many times in a row on, roulette
// ends it, too.
#define PRELIGHT_CAUGHT_AFTER 48u
#define PRELIGHT_CAUGHT_SURVIVAL 0.75f

// Where a photon is, and what its surface makes of it.
typedef struct Arrived {
  PathVertex vertex;
  Bsdf bsdf;
  Frame frame;
  float3 wo;  // back along its way, in the frame
} Arrived;

typedef struct Departure {
  float3 direction;
  float3 weight;     // of the power, the choice of the lobe undone
  uint scattered;    // PRELIGHT_SCATTERED_*
  uint medium;
} Departure;

// One lobe by chance. False: no light leaves.
bool leave(Arrived a, PathScene s, float chance, float2 u, Departure* d) {
#ifdef PRELIGHT_CAUSTICS
  const LobeChoice lobes = chooseLobes(a.bsdf, a.wo.z, false, isNarrow(a.bsdf));
#else
  const LobeChoice lobes = chooseLobes(a.bsdf, a.wo.z, true, true);
#endif
  if (!(lobeSum(lobes) > 0.0f)) return false;
  const bool through = picksTransmitted(lobes, &chance);
#ifdef PRELIGHT_GLASS
  if (chance >= lobes.diffuse + lobes.specular) {
    const float rest = clamp((chance - lobes.diffuse - lobes.specular) / lobes.glass, 0.0f, 0.99999994f);
    if (all(isequal(a.vertex.shading, a.vertex.geometric))) {
      float relativeIor2;  // scales radiance, not power
      d->direction = leaveGlass(s, a.vertex, a.bsdf, a.wo.z, rest, &d->weight, &relativeIor2, &d->medium);
    } else if (!sendThroughGlass(s, a.vertex, a.bsdf, rest, &d->direction, &d->weight, &d->medium)) {
      return false;
    }
    d->weight *= a.bsdf.glass / lobes.glass;
    d->scattered = PRELIGHT_SCATTERED_SPECULAR;
    return true;
  }
#endif
  const bool specular = chance >= lobes.diffuse;
  d->scattered = specular && isNarrow(a.bsdf) ? PRELIGHT_SCATTERED_SPECULAR : PRELIGHT_SCATTERED_WIDELY;
#ifdef PRELIGHT_MIRROR
  if (specular && a.bsdf.smooth) {
    d->direction = fromFrame(a.frame, (float3)(-a.wo.x, -a.wo.y, a.wo.z));
    if (dot(d->direction, a.vertex.geometric) <= 0.0f) return false;
    d->weight = (a.bsdf.metal + a.bsdf.layer * schlick(a.bsdf, a.wo.z)) *
                (adjointRatio(a.vertex, d->direction) / lobes.specular);
    return true;
  }
#endif
  float3 wi = sampleLobe(a.bsdf, specular, u, a.wo);
  if (wi.z <= 0.0f) return false;
  if (through) wi.z = -wi.z;
  d->direction = fromFrame(a.frame, wi);
  if (!maySee(a.bsdf, wi.z, dot(d->direction, a.vertex.geometric))) return false;
  // Each lobe by itself, so that a photon knows which one it came from.
  const Reflection f = evaluateBsdf(a.bsdf, a.wo, wi);
  const LobeChoice one = {specular ? 0.0f : 1.0f, specular ? 1.0f : 0.0f, 0.0f};
  const float density = through ? scatterDensity(a.bsdf, lobes, a.wo, wi)
                                : scatterDensity(a.bsdf, one, a.wo, wi) * (specular ? lobes.specular : lobes.diffuse);
  d->weight = (specular ? f.glossy : f.diffuse) * (adjointRatio(a.vertex, d->direction) / density);
  return true;
}

bool storesHere(PhotonPath path, Bsdf b) {
  if (!isDiffuse(b)) return false;
#ifdef PRELIGHT_CAUSTICS
  return path.scattered == PRELIGHT_SCATTERED_SPECULAR;
#elif defined(PRELIGHT_STORE_DIRECT)
  return true;
#else
  return path.scattered != 0u;
#endif
}

bool goesOnFrom(PhotonPath path, Bsdf b) {
#ifdef PRELIGHT_CAUSTICS
  return path.scattered == 0u || !isDiffuse(b);
#else
  return true;
#endif
}

void countPower(__constant const PhotonParameters* p, const float* power, float sign, long* counts) {
  for (uint c = 0; c < 3; ++c) counts[c] += (sign < 0.0f ? -1 : 1) * countsOf(p, power[c]);
}

// A photon on its way a work-item; rays, hits, queue [count]. -> outcomes [count], PRELIGHT_PHOTON_*; rays from step.next on where
// it goes on; stored [count] where it is stored; tallies [count][6]: absorbed and escaped, in counts. Next: compactPaths,
// compactPhotons, sumTallies.
__kernel void scatterPhotons(__constant const PhotonParameters* p, const PhotonStep step,
                             __global const SurfaceLine* surface, __global const ShadingLine* shading,
                             __global const LightLine* lights, __global Ray* rays, __global const Hit* hits,
                             __global const uint* queue, __global PhotonPath* paths, __global uchar* outcomes,
                             __global Photon* stored, __global long* tallies) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  const Scene scene = sceneOf(&p->scene, surface, shading, lights);
  const PathScene s = scene.surface;
  PhotonPath path = paths[queue[i]];
  const Hit hit = hits[i];
  long absorbed[3] = {0, 0, 0}, escaped[3] = {0, 0, 0};
  uchar outcome = 0;
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) {
    countPower(p, path.power, 1.0f, escaped);
  } else {
    countPower(p, path.power, 1.0f, absorbed);
    Arrived a;
    a.vertex = loadVertex(s, rays[i], hit);
    a.bsdf = loadBsdf(s, a.vertex);
    a.frame = frameAround(a.vertex.shading);
    a.wo = toFrame(a.frame, a.vertex.wo);
    float3 power = vload3(0, path.power);
#ifdef PRELIGHT_PUNCTUAL
    if (step.depth == 0u && p->source.kind == PRELIGHT_SOURCE_PUNCTUAL) {
      const float ratio = hit.t * scene.lights.punctual[p->source.light].inverseRange;
      power *= clamp(1.0f - ratio * ratio * ratio * ratio, 0.0f, 1.0f);
    }
#endif
#ifdef PRELIGHT_ABSORPTION
    uint medium = path.medium;
    if (!a.vertex.front && (s.materials[a.vertex.material].flags & PRELIGHT_SOLID) != 0u) medium = a.vertex.material;
    if (medium != PRELIGHT_NO_MEDIUM) power *= exp(-vload3(0, s.materials[medium].absorption) * hit.t);
#endif
    if (!a.vertex.front && (s.materials[a.vertex.material].flags & PRELIGHT_DOUBLE_SIDED) == 0u && largest(a.bsdf.diffuse) > 0.0f)
      outcome |= PRELIGHT_PHOTON_MET_BACK;
    if (storesHere(path, a.bsdf)) {
      Photon photon;
      vstore3(a.vertex.position, 0, photon.position);
      photon.triangle = hit.triangle;
      vstore3(power, 0, photon.power);
      photon.direction = packDirection(a.vertex.wo);
      stored[i] = photon;
      outcome |= PRELIGHT_PHOTON_STORED;
    }
    const uint photon = path.photon;
    const uint pair = PRELIGHT_PAIR_FIRST_SURFACE + step.depth * PRELIGHT_PAIRS_A_SURFACE;
    const float2 chance = photonPoint(p, photon, pair + PRELIGHT_PAIR_LOBE);
    Departure d = {(float3)(0.0f), (float3)(0.0f), 0u, path.medium};
    if (goesOnFrom(path, a.bsdf) && leave(a, s, chance.x, photonPoint(p, photon, pair + PRELIGHT_PAIR_DIRECTION), &d)) {
      float3 leaving = power * d.weight;
      path.mirrored = d.scattered == PRELIGHT_SCATTERED_SPECULAR ? path.mirrored + 1u : 0u;
      float survival = step.depth < p->rouletteDepth ? 1.0f : fmin(largest(leaving) / largest(power), 1.0f);
      if (path.mirrored > PRELIGHT_CAUGHT_AFTER) survival = fmin(survival, PRELIGHT_CAUGHT_SURVIVAL);
      if (largest(leaving) > 0.0f && chance.y < survival) {
        vstore3(leaving / survival, 0, path.power);
        path.medium = d.medium;
        path.scattered |= d.scattered;
        paths[queue[i]] = path;
        countPower(p, path.power, -1.0f, absorbed);
        rays[step.next + i] = rayFrom(a.vertex, normalize(d.direction), MAXFLOAT);
        outcome |= PRELIGHT_PHOTON_GOES_ON;
      }
    }
  }
  outcomes[i] = outcome;
  for (uint c = 0; c < 3; ++c) {
    tallies[6 * i + c] = absorbed[c];
    tallies[6 * i + 3 + c] = escaped[c];
  }
}

// order [count]: those of the photons that go on, whose rays lie from `next` on -> their rays and queue, close together.
__kernel void compactPaths(const uint count, const uint next, __global const uint* order, __global Ray* rays,
                           __global const uint* queue, __global uint* nextQueue) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  rays[i] = rays[next + order[i]];
  nextQueue[i] = queue[order[i]];
}

// order [count]: those that are stored -> photons and the numbers of their paths in the block.
__kernel void compactPhotons(const uint count, __global const uint* order, __global const Photon* stored,
                             __global const uint* queue, __global Photon* photons, __global uint* numbers) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  photons[i] = stored[order[i]];
  numbers[i] = queue[order[i]];
}

// tallies [count][columns] -> sums [work-item][columns], each over `run` of them.
__kernel void sumTallies(const uint count, const uint columns, const uint run, __global const long* tallies,
                         __global long* sums) {
  const size_t group = get_global_id(0) / columns, column = get_global_id(0) % columns;
  if (group * run >= count) return;
  long sum = 0;
  for (size_t i = group * run; i < min((size_t)count, (group + 1) * run); ++i) sum += tallies[i * columns + column];
  sums[get_global_id(0)] = sum;
}
