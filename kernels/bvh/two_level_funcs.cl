// Traversal of a tree over instances, whose leaves are trees of shapes in spaces of their own: the ray is taken there.
// Its direction is not normalised again, so distances along it are the same in both spaces.
#ifndef PRELIGHT_BVH_TWO_LEVEL_FUNCS_CL
#define PRELIGHT_BVH_TWO_LEVEL_FUNCS_CL

#include "bvh/narrow_funcs.cl"
#include "shared/instance_types.h"

// Entries that the tree over the instances needs.
#ifndef PRELIGHT_TOP_STACK_SIZE
#define PRELIGHT_TOP_STACK_SIZE 128
#endif

typedef struct TwoLevelBvh {
  __global const NarrowNode* top;  // a leaf is PRELIGHT_LEAF_BIT | instance
  __global const DeviceInstance* instances;
  __global const NarrowNode* nodes;
  __global const NarrowTriangle* triangles;
} TwoLevelBvh;

float transformRow(__global const float* row, float3 v) { return row[0] * v.x + row[1] * v.y + row[2] * v.z; }

Ray rayInObject(__global const DeviceInstance* instance, Ray ray, float tMax) {
  const float3 o = (float3)(ray.origin[0], ray.origin[1], ray.origin[2]);
  const float3 d = (float3)(ray.direction[0], ray.direction[1], ray.direction[2]);
  Ray taken;
  for (int i = 0; i < 3; ++i) {
    taken.origin[i] = transformRow(instance->toObject[i], o) + instance->toObject[i][3];
    taken.direction[i] = transformRow(instance->toObject[i], d);
  }
  // Wraps around to a triangle that the shape has not, when the source is another's.
  const uint source = ray.sourceTriangle - instance->firstTriangle;
  taken.sourceTriangle = source < instance->triangleCount ? source : PRELIGHT_NO_TRIANGLE;
  taken.tMax = tMax;
  return taken;
}

// What the ray hits of an instance at a distance of at most tMax, with the triangle counted over all instances.
Hit traceInstance(TwoLevelBvh bvh, uint index, Ray ray, float tMax) {
  __global const DeviceInstance* instance = bvh.instances + index;
  const Bvh shape = {bvh.nodes + instance->firstNode, bvh.triangles + instance->firstLeaf};
  const Surface surface = {0, 0, 0, 0, 0};  // shapes have no alpha masks
  Hit hit = traceRay(shape, surface, rayInObject(instance, ray, tMax));
#ifndef PRELIGHT_ANY_HIT
  if (hit.triangle != PRELIGHT_NO_TRIANGLE) hit.triangle += instance->firstTriangle;
#endif
  return hit;
}

// Nearest hit of a ray with all instances, or with PRELIGHT_ANY_HIT the first found, as triangle 0.
Hit traceInstances(TwoLevelBvh bvh, Ray ray) {
  const PreparedRay r = prepareRay(ray);
  const Hit miss = {0.0f, PRELIGHT_NO_TRIANGLE, 0.0f, 0.0f};
  Hit best = miss;
  best.t = r.tMax;
  uint stack[PRELIGHT_TOP_STACK_SIZE];
  uint depth = 0;
  uint current = 0;
  for (;;) {
    if (current & PRELIGHT_LEAF_BIT) {
      const Hit hit = traceInstance(bvh, current & ~PRELIGHT_LEAF_BIT, ray, best.t);
#ifdef PRELIGHT_ANY_HIT
      if (hit.triangle != PRELIGHT_NO_TRIANGLE) return hit;
#else
      // Equal distances go to the lower index, whatever the order of visits.
      if (hit.triangle != PRELIGHT_NO_TRIANGLE && (hit.t < best.t || hit.triangle < best.triangle)) best = hit;
#endif
    } else {
      __global const NarrowNode* node = bvh.top + current;
      float near0, near1;
      const bool hit0 = intersectBox(node->lower[0], node->upper[0], &r, best.t, &near0);
      const bool hit1 = intersectBox(node->lower[1], node->upper[1], &r, best.t, &near1);
      if (hit0 && hit1) {
        const uint nearer = near1 < near0 ? 1u : 0u;
        stack[depth++] = node->child[1u - nearer];
        current = node->child[nearer];
        continue;
      }
      if (hit0 || hit1) {
        current = node->child[hit1 ? 1 : 0];
        continue;
      }
    }
    if (depth == 0) return best.triangle == PRELIGHT_NO_TRIANGLE ? miss : best;
    current = stack[--depth];
  }
}

#endif
