// Closest-hit and any-hit tracing of a buffer of rays.
// Options: PRELIGHT_WIDE_BVH (8-wide layout, else narrow), PRELIGHT_ALPHA_TEST, PRELIGHT_VERTEX_COLORS,
// PRELIGHT_STACK_SIZE (entries that the tree at hand needs).

#ifndef PRELIGHT_STACK_SIZE
#define PRELIGHT_STACK_SIZE 256
#endif

#ifdef PRELIGHT_WIDE_BVH
#include "bvh/wide_funcs.cl"
#define NODE WideNode
#define TRIANGLES TriangleBlock
#else
#include "bvh/narrow_funcs.cl"
#define NODE NarrowNode
#define TRIANGLES NarrowTriangle
#endif

// A ray a work-item. rays [rayCount] -> hits [rayCount]. Next: projection.
__kernel void traceClosestHits(__global const NODE* nodes, __global const TRIANGLES* blocks,
                               __global const DeviceTriangle* triangles, __global const DeviceMaterial* materials,
                               __global const float2* texCoords, __global const float4* colors,
                               __global const ushort4* texels, __global const Ray* rays, __global Hit* hits,
                               const uint rayCount) {
  const size_t i = get_global_id(0);
  if (i >= rayCount) return;
  const Bvh bvh = {nodes, blocks};
  const Surface surface = {triangles, materials, texCoords, colors, texels};
  hits[i] = traceClosest(bvh, surface, rays[i]);
}

// As traceClosestHits, but a hit only says that there is one: triangle 0, no distance.
__kernel void traceAnyHits(__global const NODE* nodes, __global const TRIANGLES* blocks,
                           __global const DeviceTriangle* triangles, __global const DeviceMaterial* materials,
                           __global const float2* texCoords, __global const float4* colors,
                           __global const ushort4* texels, __global const Ray* rays, __global Hit* hits,
                           const uint rayCount) {
  const size_t i = get_global_id(0);
  if (i >= rayCount) return;
  const Bvh bvh = {nodes, blocks};
  const Surface surface = {triangles, materials, texCoords, colors, texels};
  const Hit hit = {0.0f, traceAny(bvh, surface, rays[i]) ? 0u : PRELIGHT_NO_TRIANGLE, 0.0f, 0.0f};
  hits[i] = hit;
}
