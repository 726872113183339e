// Receivers' rays that meet mirrors, glass or metal go on from there, each along one path, until they leave the scene
// or end on a diffuse surface:
//   listSpecular -> startSpecular -> [followSpecular -> trace] ... -> projectSpecular, and storeFollowed of
//   cast/transport_kernels.cl
// Paths that enter bodies that scatter light walk through them before followSpecular:
//   beginSpecularWalks -> [stepWalks of transport/walk_kernels.cl -> trace] ... -> endSpecularWalks
// Options: those of transport/material_funcs.cl, PRELIGHT_ABSORPTION (some glass absorbs),
// PRELIGHT_SH_ORDER (0: no SH).
#include "core/sampling_funcs.cl"
#include "shared/cast_types.h"
#include "shared/specular_types.h"
#include "transport/dispersion_funcs.cl"
#include "transport/medium_funcs.cl"
#include "transport/roulette_funcs.cl"
#include "transport/scene_funcs.cl"
#include "transport/walk_funcs.cl"

#if PRELIGHT_SH_ORDER > 0
#include "project/sh_funcs.cl"
#endif

// Pairs of random numbers per surface: lobe and roulette, direction.
#define PRELIGHT_SPECULAR_PAIRS 2u
// Paths that carry less than this share of light go on by Russian roulette. No path is given a higher weight for it
// than this: light that is trapped in glass would be found by few rays, as bright points. A path ends as absorbed after
// the host's maximum number of surfaces.
#define PRELIGHT_SURE_THROUGHPUT 0.1f

// One work-item per ray. hits [ray], specular [material] PRELIGHT_GOES_ON_... -> ends [ray], which have not met
// anything yet, and marks of the rays that go on. Next: startSpecular.
__kernel void listSpecular(const uint count, __constant const SceneLayout* layout, __global const SurfaceLine* surfaceLines,
                           __global const uchar* specular, __global const Hit* hits, __global SpecularEnd* ends,
                           __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const uint triangle = hits[i].triangle;
  const bool goesOn =
      triangle != PRELIGHT_NO_TRIANGLE && specular[materialAt(surfaceOf(layout, surfaceLines), triangle)] != 0;
  ends[i].kind = goesOn ? PRELIGHT_SPECULAR_ABSORBED : PRELIGHT_SPECULAR_MET_NONE;
  marks[i] = goesOn ? 1 : 0;
}

// One work-item per listed ray. rays, hits [ray] -> paths, pathRays, pathHits [count]. Next: followSpecular.
__kernel void startSpecular(const uint count, const uint firstListed, __global const uint* lists, __global const Ray* rays,
                            __global const Hit* hits, __global SpecularPath* paths, __global Ray* pathRays,
                            __global Hit* pathHits) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const uint from = lists[firstListed + i];
  paths[i] = (SpecularPath){{1.0f, 1.0f, 1.0f}, 1.0f, from, PRELIGHT_NO_MEDIUM, 0u};
  pathRays[i] = rays[from];
  pathHits[i] = hits[from];
}

// Returns point `pair` of the ray's own sequence, independent of the other rays of the launch.
float2 specularPoint(__constant const CastParameters* parameters, __global const Receiver* receivers, uint ray, uint pair) {
  __global const Receiver* r = receivers + ray / parameters->raysPerReceiver;
  const uint sample = r->firstSample + ray % parameters->raysPerReceiver;
  const uint2 bits = samplePaddedBits(sample, hashInteger(r->seed ^ hashInteger((pair + 1u) * 0x9e3779b9u)));
  return (float2)(unitFloat(bits.x), unitFloat(bits.y));
}

void endPath(SpecularPath path, uint kind, float3 throughput, Ray ray, Hit hit, __global SpecularEnd* ends) {
  SpecularEnd end = {{throughput.x, throughput.y, throughput.z}, kind, {ray.direction[0], ray.direction[1], ray.direction[2]},
                     hit.triangle, hit.u, hit.v};
  ends[path.ray] = end;
}

// Continues a path from a surface along `sample`. Returns false when it ends there.
bool goOn(PathScene s, Interaction surface, Bsdf b, BsdfSample sample, float wave, float chance, SpecularPath* path,
          __global Ray* next) {
  float3 throughput = carriedBy(sample, vload3(0, path->throughput));
#ifdef PRELIGHT_DISPERSION
  if (path->dispersed == 0u && takesColor(s, surface, b, sample.lobe)) {
    throughput *= colorOfWave(wave);
    path->dispersed = 1u;
  }
#endif
  path->relativeIor2 *= sample.eta2;
  const float survival = fmin(largest(throughput) * path->relativeIor2 / PRELIGHT_SURE_THROUGHPUT, 1.0f);
  if (!survives(survival, chance, &throughput)) return false;
  vstore3(throughput, 0, path->throughput);
  path->medium = mediumAfter(surface, sample.lobe, path->medium);
  *next = rayFrom(surface, normalize(sample.direction), MAXFLOAT);
  return true;
}

// One work-item per path, at the end of its ray. rays, hits, paths [count] -> either the path ends and writes ends [ray
// of the block], or it goes on in the same place of the buffers from step.next on and is marked.
__kernel void followSpecular(__constant const CastParameters* parameters, const SpecularStep step,
                             __constant const SceneLayout* layout, __global const SurfaceLine* surfaceLines,
                             __global const ShadingLine* shadingLines, __global const uchar* specular,
                             __global const Receiver* receivers, __global SpecularPath* paths, __global Ray* rays,
                             __global const Hit* hits, __global SpecularEnd* ends, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  marks[i] = 0;
  SpecularPath path = paths[i];
  const Ray ray = rays[i];
  const Hit hit = hits[i];
  if (hit.triangle == PRELIGHT_NO_TRIANGLE) {
    endPath(path, PRELIGHT_SPECULAR_SKY, vload3(0, path.throughput), ray, hit, ends);
    return;
  }
  const PathScene s = shadedSurfaceOf(layout, surfaceLines, shadingLines);
  const Interaction surface = loadInteraction(s, ray, hit);
#ifdef PRELIGHT_ABSORPTION
  const uint medium = mediumBefore(surface, path.medium);
  if (absorbsOnly(s, medium)) vstore3(vload3(0, path.throughput) * transmittance(s, medium, hit.t), 0, path.throughput);
#endif
  if ((specular[surface.material] & PRELIGHT_GOES_ON_SPECULARLY) == 0) {
    endPath(path, PRELIGHT_SPECULAR_SURFACE, vload3(0, path.throughput), ray, hit, ends);
    return;
  }
  Bsdf b = loadBsdf(s, surface);
  const uint pair = 1u + step.depth * PRELIGHT_SPECULAR_PAIRS;
  const float2 chance = specularPoint(parameters, receivers, path.ray, pair);
  const float2 u = specularPoint(parameters, receivers, path.ray, pair + 1u);
  const float wave = specularPoint(parameters, receivers, path.ray, 0u).x;
#ifdef PRELIGHT_DISPERSION
  disperse(s, surface, wave, path.dispersed != 0u, &b);
#endif
  BsdfSample sample;
  if (!sampleBsdf(surface, b, PRELIGHT_LOBES_ALL | PRELIGHT_LOBES_APART, PRELIGHT_RADIANCE, chance.x, u, &sample)) return;
  if ((sample.lobe & PRELIGHT_LOBES_DIFFUSE) != 0u) {
    const uint kind = sample.lobe == PRELIGHT_LOBE_THROUGH ? PRELIGHT_SPECULAR_THROUGH : PRELIGHT_SPECULAR_BODY;
    endPath(path, kind, carriedBy(sample, vload3(0, path.throughput)), ray, hit, ends);
    return;
  }
  if (!goOn(s, surface, b, sample, wave, chance.y, &path, rays + step.next + i)) return;
  paths[step.next + i] = path;
  marks[i] = 1;
}

// One work-item per path, at the end of its ray -> walks [count], and marks where a walk begins.
__kernel void beginSpecularWalks(__constant const CastParameters* parameters, const SpecularStep step,
                                 __constant const SceneLayout* layout, __global const SurfaceLine* surfaceLines,
                                 __global const ShadingLine* shadingLines, __global const Receiver* receivers,
                                 __global const SpecularPath* paths, __global const Ray* rays, __global const Hit* hits,
                                 __global MediumWalk* walks, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  const PathScene s = shadedSurfaceOf(layout, surfaceLines, shadingLines);
  const SpecularPath path = paths[i];
  uint medium = path.medium;
  if (hits[i].triangle != PRELIGHT_NO_TRIANGLE) medium = mediumBefore(loadInteraction(s, rays[i], hits[i]), medium);
  const bool within = scattersWithin(s, medium);
  __global const Receiver* r = receivers + path.ray / parameters->raysPerReceiver;
  const uint sample = r->firstSample + path.ray % parameters->raysPerReceiver;
  const uint seed = hashInteger(sample ^ hashInteger(r->seed ^ hashInteger((step.depth + 1u) * 0x85ebca6bu)));
  walks[i] = within ? beginWalk(s, medium, (uint)i, vload3(0, path.throughput), seed) : noWalk();
  marks[i] = within ? 1 : 0;
}

// One work-item per path. walks [count] -> throughputs of paths. An absorbed walk ends without a surface and counts as
// sky with weight 0.
__kernel void endSpecularWalks(const uint count, __global const MediumWalk* walks, __global SpecularPath* paths) {
  const size_t i = get_global_id(0);
  if (i >= count || walks[i].medium == PRELIGHT_NO_MEDIUM) return;
  vstore3(vload3(0, walks[i].weight), 0, paths[i].throughput);
}

#if PRELIGHT_SH_ORDER > 0
// One work-item per receiver. ends [receiver][raysPerReceiver] -> values [receiver][3][i], the mean over the receiver's
// rays of throughput x Y_i of those that end in the sky. shTable as in sh_funcs.cl.
__kernel void projectSpecular(__constant const CastParameters* parameters, __constant const float* shTable,
                              __global const SpecularEnd* ends, __global float* values) {
  const size_t receiver = get_global_id(0);
  if (receiver >= parameters->receiverCount) return;
  const uint columns = PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER;
  const float scale = 1.0f / (float)parameters->raysPerReceiver;
  values += receiver * 3 * columns;
  ends += receiver * parameters->raysPerReceiver;
  for (uint i = 0; i < 3 * columns; ++i) values[i] = 0.0f;
  for (uint j = 0; j < parameters->raysPerReceiver; ++j) {
    if (ends[j].kind != PRELIGHT_SPECULAR_SKY) continue;
    float basis[PRELIGHT_SH_ORDER * PRELIGHT_SH_ORDER];
    evaluateSh(shTable, vload3(0, ends[j].direction), basis);
    for (uint c = 0; c < 3; ++c)
      for (uint i = 0; i < columns; ++i) values[c * columns + i] += scale * ends[j].throughput[c] * basis[i];
  }
}
#endif
