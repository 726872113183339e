// Tracing of a buffer of rays through the narrow tree.
// Options: PRELIGHT_ANY_HIT (a hit only says that there is one; otherwise the closest is found), PRELIGHT_ALPHA_TEST,
// PRELIGHT_VERTEX_COLORS, PRELIGHT_SHARED_SURFACE, PRELIGHT_INSTANCES (the tree has two levels), PRELIGHT_STACK_SIZE
// (entries that the tree needs).
#include "bvh/narrow_funcs.cl"

// One work-item per ray. rays [firstRay + rayCount], from index firstRay on -> hits [rayCount].
__kernel void traceRays(__global const NarrowNode* nodes, __global const NarrowTriangle* leaves,
                        __global const DeviceInstance* instances, __constant const SceneLayout* layout, __global const SurfaceLine* surfaceLines,
                        __global const Ray* rays, __global Hit* hits, const uint firstRay, const uint rayCount) {
  const size_t i = get_global_id(0);
  if (i >= rayCount) return;
  const Bvh bvh = {nodes, leaves, instances};
  const Surface surface = surfaceOf(layout, surfaceLines);
  RayTask task;
  hits[i] = traceRay(bvh, surface, rays[firstRay + i], &task);
}
