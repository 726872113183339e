// Tracing of a buffer of rays through the narrow tree.
// Options: PRELIGHT_ANY_HIT (a hit only says that there is one; else the closest), PRELIGHT_ALPHA_TEST,
// PRELIGHT_VERTEX_COLORS, PRELIGHT_STACK_SIZE (entries that the tree at hand needs).

#ifndef PRELIGHT_STACK_SIZE
#define PRELIGHT_STACK_SIZE 256
#endif

#include "bvh/narrow_funcs.cl"

// A ray a work-item. rays [rayCount] -> hits [rayCount].
__kernel void traceRays(__global const NarrowNode* nodes, __global const NarrowTriangle* leaves,
                        __global const DeviceTriangle* triangles, __global const DeviceMaterial* materials,
                        __global const float2* texCoords, __global const float4* colors,
                        __global const ushort4* texels, __global const Ray* rays, __global Hit* hits,
                        const uint rayCount) {
  const size_t i = get_global_id(0);
  if (i >= rayCount) return;
  const Bvh bvh = {nodes, leaves};
  const Surface surface = {triangles, materials, texCoords, colors, texels};
  hits[i] = traceRay(bvh, surface, rays[i]);
}
