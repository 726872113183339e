// Camera paths that end where they meet precomputed light. All work at a surface is done in one kernel, because most of
// the time goes into looking up the surface's material.
//   generatePaths -> [trace -> followPaths -> trace -> addArrivals] ... -> averageSamples, measureExcess
// Options: those of the included files, PRELIGHT_CACHED_CAUSTICS (there are caustic photons).
#include "gather/irradiance_map_funcs.cl"
#ifdef PRELIGHT_CACHED_CAUSTICS
#include "photon/density_funcs.cl"
#endif
#include "integrate/culled_kernels.cl"
#include "integrate/path_ends_kernels.cl"
#include "integrate/path_point_funcs.cl"
#include "shared/cached_light_types.h"
#include "transport/irradiance_funcs.cl"
#include "transport/scene_funcs.cl"

#ifdef PRELIGHT_CACHED_CAUSTICS
// Adds the irradiance of caustics in front of the vertex, and beyond it where the surface is translucent. Caustics are
// smooth over a pixel, because their filter is wider, and they cost most: of a pixel's samples that see a surface
// directly, only causticSamples look them up, on behalf of all. Glass and mirrors spread a pixel's samples to distant
// places, so there every sample looks them up.
PRELIGHT_INLINE void addCaustics(__constant const CachedPathParameters* c, IrradianceMap map, __global const DensityLine* maps,
                                 uint depth, PathPoint at, float3* irradiance, float3* beyond) {
  const uint samples = c->paths.samplesPerPass;
  const bool shared = depth == 0u;
  if (shared && at.path % samples >= c->causticSamples) return;
  const DensityMaps photons = densityMapsOf(&c->caustics, maps);
  const float share = shared ? (float)samples / (float)c->causticSamples : 1.0f;
  const Interaction v = at.surface;
  const uint patch = patchAt(map, v.triangle, v.front, v.u, v.v);
  *irradiance += photonIrradiance(photons, v.position, v.geometric, v.triangle, patch, c->causticRadius) * share;
#ifdef PRELIGHT_TRANSLUCENT
  const uint other = patchAt(map, v.triangle, !v.front, v.u, v.v);
  if (largest(at.bsdf.transmitted) > 0.0f)
    *beyond += photonIrradiance(photons, v.position, -v.geometric, v.triangle, other, c->causticRadius) * share;
#endif
}
#endif

// Returns the radiance that a surface sends towards the camera from precomputed light. `caustic`: the part of it that
// comes from caustics.
PRELIGHT_INLINE float3 cachedRadiance(__constant const CachedPathParameters* c, __global const IrradianceLine* indirect,
                                      __global const DensityLine* maps, uint depth, PathPoint at, float3* caustic) {
  const IrradianceMap map = irradianceMapOf(&c->indirect, indirect);
  const Interaction v = at.surface;
  float3 irradiance = irradianceAt(map, v.triangle, v.front, v.u, v.v);
  float3 beyond = (float3)(0.0f);
#ifdef PRELIGHT_TRANSLUCENT
  beyond = irradianceAt(map, v.triangle, !v.front, v.u, v.v);
#endif
#ifdef PRELIGHT_CACHED_CAUSTICS
  const float3 gathered = irradiance, gatheredBeyond = beyond;
  addCaustics(c, map, maps, depth, at, &irradiance, &beyond);
  if (keepsParts(&c->paths)) {
    *caustic = reflectIrradiance(at.bsdf, v.woLocal, irradiance - gathered);
#ifdef PRELIGHT_TRANSLUCENT
    *caustic += transmitIrradiance(at.bsdf, v.woLocal, beyond - gatheredBeyond);
#endif
  }
#endif
  float3 radiance = reflectIrradiance(at.bsdf, v.woLocal, irradiance);
#ifdef PRELIGHT_TRANSLUCENT
  radiance += transmitIrradiance(at.bsdf, v.woLocal, beyond);
#endif
  return radiance;
}

#ifdef PRELIGHT_PANES
// Takes a path that only looks for lights straight through a pane. Returns false when it ends.
PRELIGHT_INLINE bool passPane(PathPoint at, float way, PathState* path, Ray* next) {
  if (!isPane(at.surface, at.bsdf)) return false;
  const float3 throughput = vload3(0, path->throughput) * paneTransmittance(at.surface, at.bsdf);
  if (!(largest(throughput) > 0.0f) || !notePane(way, path)) return false;
  vstore3(throughput, 0, path->throughput);
  *next = rayFrom(at.surface, -at.surface.wo, MAXFLOAT);
  return true;
}
#endif

// Stores a path's gain from precomputed light in its parts, `caustic` of it as caustics.
PRELIGHT_INLINE void keepCached(__constant const ReferenceParameters* p, __global PathState* paths, uint number, float3 throughput,
                                float3 radiance, float3 caustic) {
  if (!keepsParts(p)) return;
  const uint way = partsOf(p->parts, paths, number)->way;
  keepPart(p->parts, paths, number, partOfArriving(way, PRELIGHT_PART_INDIRECT), throughput * (radiance - caustic));
  keepPart(p->parts, paths, number, partOfArriving(way, PRELIGHT_PART_CAUSTIC), throughput * caustic);
}

// One work-item per ray. maps: read only with PRELIGHT_CACHED_CAUSTICS. -> shadow rays from step.shadow on, continuing
// rays from step.next on, and marks.
__kernel void followPaths(__constant const CachedPathParameters* c, const PathStep step,
                          __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                          __global const LightLine* lightLines, __global const IrradianceLine* indirect,
                          __global const DensityLine* maps, __global Ray* rays, __global const Hit* hits,
                          __global const uint* numbers, __global PathState* paths, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  __constant const ReferenceParameters* p = &c->paths;
  const Scene scene = sceneOf(&p->scene, surfaceLines, shadingLines, lightLines);
  const Ray ray = rays[i];
  const Hit hit = hits[i];
  const uint number = numbers[i];
  const PathState before = paths[number];
  PathState path = before;
  uchar mark = 0;
  Interaction surface;
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) surface = loadInteraction(scene.surface, ray, hit);
  collectAt(p, step.depth, scene.surface, scene.lights, ray, hit, surface, &path);
  keepCollected(p, paths, number, before.radiance, &path);
  // A ray of a diffuse lobe only looks for lights.
  const bool meets = step.meets != 0u && path.diffuseBounces == 0u && !isComplete(p, step.depth, path);
  if (hit.triangle != PRELIGHT_NO_TRIANGLE && meets) {
    const PathPoint at = dispersedAt(p, scene.surface, pathPointAt(scene.surface, surface, number), path);
    if (isDiffuse(at.bsdf)) {
      float3 caustic = (float3)(0.0f);
      const float3 radiance = cachedRadiance(c, indirect, maps, step.depth, at, &caustic);
      keepCached(p, paths, number, vload3(0, path.throughput), radiance, caustic);
      vstore3(vload3(0, path.radiance) + vload3(0, path.throughput) * radiance, 0, path.radiance);
    }
    Ray shadow;
    float3 arriving;
    if (p->scene.lights.groupCount > 0u &&
        sampleLightAt(p, step.depth, scene.surface, scene.lights, at, path, PRELIGHT_NO_TRIANGLE, &shadow, &arriving)) {
      rays[step.shadow + i] = shadow;
      vstore3(arriving, 0, path.arriving);
      noteArriving(p, paths, number, PRELIGHT_PART_DIRECT);
      mark |= 1u << PRELIGHT_PATH_SHADOW;
    }
    Ray next;
    if (step.goesOn != 0u && scatterAt(p, step.depth, scene.surface, at, hit.t, &path, &next)) {
      noteWay(p, paths, number, &before, &path);
      rays[step.next + i] = next;
      mark |= 1u << PRELIGHT_PATH_NEXT;
    }
  }
#ifdef PRELIGHT_PANES
  Ray beyond;
  if (hit.triangle != PRELIGHT_NO_TRIANGLE && !meets &&
      passPane(pathPointAt(scene.surface, surface, number), hit.t, &path, &beyond)) {
    rays[step.next + i] = beyond;
    mark = 1u << PRELIGHT_PATH_NEXT;
  }
#endif
  paths[number] = path;
  marks[i] = mark;
}

// One work-item per pixel of the block. paths [pixel][samplesPerPass] -> excess [pixel]: luminance by which the brightest
// sample raises the mean over what it would be if that sample were as bright as the second brightest.
__kernel void measureExcess(__constant const ReferenceParameters* p, __global const PathState* paths,
                            __global float* excess) {
  const size_t i = get_global_id(0);
  const uint n = p->samplesPerPass;
  if (i >= p->pathCount / n) return;
  float first = 0.0f, second = 0.0f;
  for (uint s = 0; s < n; ++s) {
    const float value = dot(vload3(0, paths[i * n + s].radiance), (float3)(0.2126f, 0.7152f, 0.0722f));
    second = fmax(second, fmin(first, value));
    first = fmax(first, value);
  }
  excess[i] = n > 1u ? (first - second) / (float)n : 0.0f;
}
