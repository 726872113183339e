// The reference path tracer, a wavefront: bvh/wide_kernels.cl or bvh/narrow_kernels.cl trace rays, these kernels do the rest.
//   generatePaths -> [trace -> collectRadiance -> sampleLights -> trace -> addArrivals -> scatterPaths] ... -> averageSamples
// The queue tells which path a ray belongs to: see PathStep. The order within it is left to chance; nothing depends on
// it, because every path has random numbers and a state of its own.
// Options: those of the included files.
#include "integrate/path_ends_kernels.cl"
#include "integrate/path_point_funcs.cl"
#include "transport/scene_funcs.cl"

// A ray a work-item. Adds what the surface or the sky sends along the ray and takes away what glass absorbs.
__kernel void collectRadiance(__constant const ReferenceParameters* p, const PathStep step,
                              __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                              __global const LightLine* lightLines, __global const Ray* rays,
                              __global const Hit* hits, __global const uint* queue, __global PathState* paths) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  const Scene scene = sceneOf(&p->scene, surfaceLines, shadingLines, lightLines);
  const Ray ray = rays[step.first + i];
  const Hit hit = hits[i];
  const uint number = queue[PRELIGHT_QUEUE_HEAD + step.first + i];
  PathState path = paths[number];
  Interaction surface;
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) surface = loadInteraction(scene.surface, ray, hit);
  collectAt(p, step.depth, scene.surface, scene.lights, ray, hit, surface, &path);
  paths[number] = path;
}

// A ray a work-item. Light that could arrive directly where the ray ends. -> shadow rays and items [shadow counter].
__kernel void sampleLights(__constant const ReferenceParameters* p, const PathStep step,
                           __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                           __global const LightLine* lightLines, __global Ray* rays, __global const Hit* hits,
                           __global uint* queue, __global const PathState* paths, __global ShadowItem* items) {
  const size_t i = get_global_id(0);
  if (i >= step.count || hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const Scene scene = sceneOf(&p->scene, surfaceLines, shadingLines, lightLines);
  const uint number = queue[PRELIGHT_QUEUE_HEAD + step.first + i];
  Ray shadow;
  ShadowItem item;
  const PathPoint at = pathPointAt(scene.surface, loadInteraction(scene.surface, rays[step.first + i], hits[i]), number);
  if (!sampleLightAt(p, step.depth, scene.surface, scene.lights, at, paths[number], step.light, &shadow, &item)) return;
  const uint place = atomic_inc(queue + PRELIGHT_SHADOW_COUNTER);
  rays[step.shadow + place] = shadow;
  items[place] = item;
}

// A ray a work-item. Draws the direction in which the path goes on. -> rays that go on [next counter].
__kernel void scatterPaths(__constant const ReferenceParameters* p, const PathStep step,
                           __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                           __global Ray* rays, __global const Hit* hits, __global uint* queue,
                           __global PathState* paths) {
  const size_t i = get_global_id(0);
  if (i >= step.count || hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const PathScene s = shadedSurfaceOf(&p->scene, surfaceLines, shadingLines);
  const uint number = queue[PRELIGHT_QUEUE_HEAD + step.first + i];
  PathState path = paths[number];
  Ray next;
  if (!scatterAt(p, step.depth, pathPointAt(s, loadInteraction(s, rays[step.first + i], hits[i]), number), &path, &next)) return;
  paths[number] = path;
  const uint place = atomic_inc(queue + PRELIGHT_NEXT_COUNTER);
  rays[step.next + place] = next;
  queue[PRELIGHT_QUEUE_HEAD + step.next + place] = number;
}
