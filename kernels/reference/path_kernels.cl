// The reference path tracer, a wavefront: bvh/wide_kernels.cl or bvh/narrow_kernels.cl trace rays, these kernels do the rest.
//   generatePaths -> [trace -> collectRadiance -> sampleLights -> trace -> addArrivals -> scatterPaths] ... -> averageSamples
// queue [ray] tells which path a ray belongs to. The order within a queue is left to chance; nothing depends on it,
// because every path has random numbers and a state of its own.
// Options: those of the included files.
#include "reference/path_ends_kernels.cl"
#include "reference/path_point_funcs.cl"

// A ray a work-item. Adds what the surface or the sky sends along the ray and takes away what glass absorbs.
__kernel void collectRadiance(__constant const ReferenceParameters* p, const uint count, const uint depth,
                              __global const Ray* rays, __global const Hit* hits, __global const uint* queue,
                              __global PathState* paths, __global const DeviceTriangle* triangles,
                              __global const DeviceMaterial* bases, __global const float2* texCoords,
                              __global const float4* colors, __global const ushort4* texels,
                              __global const float* vertices, __global const uchar* flat,
                              __global const ShadeMaterial* materials, __global const DeviceMaterial* layers,
                              __global const ushort4* layerTexels, __global const uint* tables,
                              __global const uint* emitters, __global const float* emitterDensities,
                              __global const PunctualLight* punctual, __global const float4* sky) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, layers, layerTexels};
  const Lights lights = {tables, emitters, emitterDensities, punctual, sky};
  const Ray ray = rays[i];
  const Hit hit = hits[i];
  PathState path = paths[queue[i]];
  Interaction surface;
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) surface = loadInteraction(s, ray, hit);
  collectAt(p, depth, s, lights, ray, hit, surface, &path);
  paths[queue[i]] = path;
}

// A ray a work-item. Light that could arrive directly where the ray ends. With `light` below groupCount that punctual
// light, else one by chance. -> shadowRays, items [counters[0]].
__kernel void sampleLights(__constant const ReferenceParameters* p, const uint count, const uint depth,
                           __global const Ray* rays, __global const Hit* hits, __global const uint* queue,
                           __global const PathState* paths, __global const DeviceTriangle* triangles,
                           __global const DeviceMaterial* bases, __global const float2* texCoords,
                           __global const float4* colors, __global const ushort4* texels,
                           __global const float* vertices, __global const uchar* flat,
                           __global const ShadeMaterial* materials, __global const DeviceMaterial* layers,
                           __global const ushort4* layerTexels, __global const uint* tables,
                           __global const uint* emitters, __global const float* emitterDensities,
                           __global const PunctualLight* punctual, __global const float4* sky, const uint light,
                           __global Ray* shadowRays, __global ShadowItem* items, __global uint* counters) {
  const size_t i = get_global_id(0);
  if (i >= count || hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, layers, layerTexels};
  const Lights lights = {tables, emitters, emitterDensities, punctual, sky};
  Ray shadow;
  ShadowItem item;
  const PathPoint at = pathPointAt(s, loadInteraction(s, rays[i], hits[i]), queue[i]);
  if (!sampleLightAt(p, depth, s, lights, at, paths[queue[i]], light, &shadow, &item)) return;
  const uint slot = atomic_inc(counters);
  shadowRays[slot] = shadow;
  items[slot] = item;
}

// A ray a work-item. Draws the direction in which the path goes on. -> nextRays, nextQueue [counters[1]].
__kernel void scatterPaths(__constant const ReferenceParameters* p, const uint count, const uint depth,
                           __global const Ray* rays, __global const Hit* hits, __global const uint* queue,
                           __global PathState* paths, __global const DeviceTriangle* triangles,
                           __global const DeviceMaterial* bases, __global const float2* texCoords,
                           __global const float4* colors, __global const ushort4* texels,
                           __global const float* vertices, __global const uchar* flat,
                           __global const ShadeMaterial* materials, __global const DeviceMaterial* layers,
                           __global const ushort4* layerTexels, __global Ray* nextRays, __global uint* nextQueue,
                           __global uint* counters) {
  const size_t i = get_global_id(0);
  if (i >= count || hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const PathScene s = {{triangles, bases, texCoords, colors, texels}, vertices, flat, materials, layers, layerTexels};
  PathState path = paths[queue[i]];
  Ray next;
  if (!scatterAt(p, depth, pathPointAt(s, loadInteraction(s, rays[i], hits[i]), queue[i]), &path, &next)) return;
  paths[queue[i]] = path;
  const uint slot = atomic_inc(counters + 1);
  nextRays[slot] = next;
  nextQueue[slot] = queue[i];
}
