// The wavefront reference path tracer: bvh/wide_kernels.cl or bvh/narrow_kernels.cl trace rays, these kernels do the
// rest.
//   generatePaths -> [trace -> collectRadiance -> sampleLights -> trace -> addArrivals -> scatterPaths] ... ->
//   averageSamples
// `numbers` holds the path of each ray. Rays that a step continues are marked, listed in the order of the rays and
// compacted (core/queue_kernels.cl).
// Options: those of the included files.
#include "integrate/culled_kernels.cl"
#include "integrate/path_ends_kernels.cl"
#include "integrate/path_point_funcs.cl"
#include "transport/scene_funcs.cl"

// One work-item per ray. Adds the radiance that the surface or the sky emits along the ray, and applies the absorption
// of glass.
__kernel void collectRadiance(__constant const ReferenceParameters* p, const PathStep step,
                              __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                              __global const LightLine* lightLines, __global const Ray* rays,
                              __global const Hit* hits, __global const uint* numbers, __global PathState* paths) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  const Scene scene = sceneOf(&p->scene, surfaceLines, shadingLines, lightLines);
  const Ray ray = rays[i];
  const Hit hit = hits[i];
  const uint number = numbers[i];
  const PathState before = paths[number];
  PathState path = before;
  Interaction surface;
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) surface = loadInteraction(scene.surface, ray, hit);
  collectAt(p, step.depth, scene.surface, scene.lights, ray, hit, surface, &path);
  paths[number] = path;
  keepCollected(p, paths, number, before.radiance, &path);
}

// One work-item per ray. Samples light that may arrive directly at the ray's end. -> shadow rays from step.shadow on,
// and marks.
__kernel void sampleLights(__constant const ReferenceParameters* p, const PathStep step,
                           __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                           __global const LightLine* lightLines, __global Ray* rays, __global const Hit* hits,
                           __global const uint* numbers, __global PathState* paths, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  marks[i] = 0;
  if (hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const Scene scene = sceneOf(&p->scene, surfaceLines, shadingLines, lightLines);
  const uint number = numbers[i];
  Ray shadow;
  float3 arriving;
  const PathPoint met = pathPointAt(scene.surface, loadInteraction(scene.surface, rays[i], hits[i]), number);
  const PathPoint at = dispersedAt(p, scene.surface, met, paths[number]);
  if (!sampleLightAt(p, step.depth, scene.surface, scene.lights, at, paths[number], step.light, &shadow, &arriving)) return;
  rays[step.shadow + i] = shadow;
  vstore3(arriving, 0, paths[number].arriving);
  noteArriving(p, paths, number, PRELIGHT_PART_DIRECT);
  marks[i] = 1u << PRELIGHT_PATH_SHADOW;
}

// One work-item per ray. Draws the direction in which the path goes on. -> rays from step.next on, and marks.
__kernel void scatterPaths(__constant const ReferenceParameters* p, const PathStep step,
                           __global const SurfaceLine* surfaceLines, __global const ShadingLine* shadingLines,
                           __global Ray* rays, __global const Hit* hits, __global const uint* numbers,
                           __global PathState* paths, __global uchar* marks) {
  const size_t i = get_global_id(0);
  if (i >= step.count) return;
  marks[i] = 0;
  if (hits[i].triangle == PRELIGHT_NO_TRIANGLE) return;
  const PathScene s = shadedSurfaceOf(&p->scene, surfaceLines, shadingLines);
  const uint number = numbers[i];
  const PathState before = paths[number];
  PathState path = before;
  Ray next;
  const PathPoint at = dispersedAt(p, s, pathPointAt(s, loadInteraction(s, rays[i], hits[i]), number), path);
  if (!scatterAt(p, step.depth, s, at, hits[i].t, &path, &next)) return;
  paths[number] = path;
  noteWay(p, paths, number, &before, &path);
  rays[step.next + i] = next;
  marks[i] = 1u << PRELIGHT_PATH_NEXT;
}
