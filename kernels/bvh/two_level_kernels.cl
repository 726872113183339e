// Tracing of a buffer of rays through instances of shapes.
// Options: PRELIGHT_ANY_HIT (a hit only says that there is one; else the closest), PRELIGHT_STACK_SIZE and
// PRELIGHT_TOP_STACK_SIZE (entries that the shapes' trees and the tree over the instances need).

#ifndef PRELIGHT_STACK_SIZE
#define PRELIGHT_STACK_SIZE 256
#endif

#include "bvh/two_level_funcs.cl"

// A ray a work-item. rays [rayCount] -> hits [rayCount].
__kernel void traceRays(__global const NarrowNode* top, __global const DeviceInstance* instances,
                        __global const NarrowNode* nodes, __global const NarrowTriangle* leaves,
                        __global const Ray* rays, __global Hit* hits, const uint rayCount) {
  const size_t i = get_global_id(0);
  if (i >= rayCount) return;
  const TwoLevelBvh bvh = {top, instances, nodes, leaves};
  hits[i] = traceInstances(bvh, rays[i]);
}
