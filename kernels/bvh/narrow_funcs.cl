// Traversal of the narrow layout: one work-item per ray, two boxes per node (Aila and Laine 2009), scalar triangles.
#ifndef PRELIGHT_BVH_NARROW_FUNCS_CL
#define PRELIGHT_BVH_NARROW_FUNCS_CL

#ifndef PRELIGHT_STACK_SIZE
#define PRELIGHT_STACK_SIZE 256
#endif
#include "transport/alpha_funcs.cl"
#include "bvh/intersect_funcs.cl"
#include "bvh/shadow_funcs.cl"
#include "shared/bvh_types.h"
#include "shared/instance_types.h"

// The narrow tree in its buffers.
typedef struct Bvh {
  __global const NarrowNode* nodes;
  __global const NarrowTriangle* triangles;
  __global const DeviceInstance* instances;
} Bvh;

// Returns true when the ray meets the box in [0, tMax] and writes the entry distance to *tNear. tFar grows by a few ulp
// (Ize 2013).
bool intersectBox(__global const float* lower, __global const float* upper, const PreparedRay* r, float tMax, float* tNear) {
  const float3 a = (vload3(0, lower) - r->origin) * r->inverseDirection;
  const float3 b = (vload3(0, upper) - r->origin) * r->inverseDirection;
  const float3 near = fmin(a, b);
  const float3 far = fmax(a, b);
  *tNear = fmax(fmax(near.x, near.y), fmax(near.z, 0.0f));
  const float tFar = fmin(fmin(far.x, far.y), fmin(far.z, tMax)) * 1.0000004f;
  return *tNear <= tFar;
}

// Returns the distance to the triangle's plane in units of the direction; NaN or infinity when it is seen edge-on.
float planeDistance(__global const NarrowTriangle* triangle, const PreparedRay* r) {
#pragma OPENCL FP_CONTRACT OFF
  const float ax = triangle->vertex[0][r->kx], ay = triangle->vertex[0][r->ky], az = triangle->vertex[0][r->kz];
  const float bx = triangle->vertex[1][r->kx] - ax, by = triangle->vertex[1][r->ky] - ay, bz = triangle->vertex[1][r->kz] - az;
  const float cx = triangle->vertex[2][r->kx] - ax, cy = triangle->vertex[2][r->ky] - ay, cz = triangle->vertex[2][r->kz] - az;
  const float nx = PRELIGHT_DIFFERENCE_OF_PRODUCTS(by, cz, bz, cy);
  const float ny = PRELIGHT_DIFFERENCE_OF_PRODUCTS(bz, cx, bx, cz);
  const float nz = PRELIGHT_DIFFERENCE_OF_PRODUCTS(bx, cy, by, cx);
  const float ox = axisOf(r->origin, r->kx), oy = axisOf(r->origin, r->ky), oz = axisOf(r->origin, r->kz);
  return (nx * (ax - ox) + ny * (ay - oy) + nz * (az - oz)) / (nx * r->sx + ny * r->sy + nz) * r->sz;
}

bool intersectTriangle(__global const NarrowTriangle* triangle, const PreparedRay* r, float tMax, float* t, float* u, float* v) {
#pragma OPENCL FP_CONTRACT OFF
  const float ox = axisOf(r->origin, r->kx), oy = axisOf(r->origin, r->ky), oz = axisOf(r->origin, r->kz);
  const float az = triangle->vertex[0][r->kz] - oz;
  const float bz = triangle->vertex[1][r->kz] - oz;
  const float cz = triangle->vertex[2][r->kz] - oz;
  const float ax = triangle->vertex[0][r->kx] - ox - r->sx * az;
  const float ay = triangle->vertex[0][r->ky] - oy - r->sy * az;
  const float bx = triangle->vertex[1][r->kx] - ox - r->sx * bz;
  const float by = triangle->vertex[1][r->ky] - oy - r->sy * bz;
  const float cx = triangle->vertex[2][r->kx] - ox - r->sx * cz;
  const float cy = triangle->vertex[2][r->ky] - oy - r->sy * cz;
  const float eu = cx * by - cy * bx;
  const float ev = ax * cy - ay * cx;
  const float ew = bx * ay - by * ax;
  const bool inside = (eu >= 0.0f && ev >= 0.0f && ew >= 0.0f) || (eu <= 0.0f && ev <= 0.0f && ew <= 0.0f);
  const float determinant = eu + ev + ew;
  if (!inside || determinant == 0.0f || triangle->triangle == r->sourceTriangle) return false;
  const float inverse = 1.0f / determinant;
  *u = ev * inverse;
  *v = ew * inverse;
  *t = (eu * az + ev * bz + ew * cz) * r->sz * inverse;
  const float low = fmin(fmin(az, bz), cz), high = fmax(fmax(az, bz), cz);
  const float extent = fabs(ax) + fabs(bx) + fabs(cx) + fabs(ay) + fabs(by) + fabs(cy);
  if (low < 0.0f && high > 0.0f && fabs(determinant) < PRELIGHT_NEEDLE * extent * (extent + high - low)) {
    const float plane = planeDistance(triangle, r);
    if (plane >= fmin(low * r->sz, high * r->sz) && plane <= fmax(low * r->sz, high * r->sz)) *t = plane;
  }
  return *t >= 0.0f && *t <= tMax;
}

#ifdef PRELIGHT_INSTANCES
// Returns true for a leaf without triangles, which stands for an instance.
bool isInstance(uint child) { return (child & ~PRELIGHT_LEAF_FIRST_MASK) == PRELIGHT_LEAF_BIT; }

// Returns the ray in an instance's space. Its direction is not normalised again, so distances along it stay equal.
PreparedRay rayWithin(__global const DeviceInstance* instance, Ray ray) {
  const float3 o = vload3(0, ray.origin) - vload3(0, instance->centre), d = vload3(0, ray.direction);
  for (int i = 0; i < 3; ++i) {
    const float3 row = vload3(0, instance->toShape[i]);
    ray.origin[i] = dot(row, o);
    ray.direction[i] = dot(row, d);
  }
  // Wraps around to a triangle that the shape does not have when the source is in another instance.
  const uint own = ray.sourceTriangle - instance->firstTriangle;
  ray.sourceTriangle = own < instance->triangleCount ? own : PRELIGHT_NO_TRIANGLE;
  return prepareRay(ray);
}
#endif

// The ray that is traced and, for shadow rays, what surfaces have let through so far.
typedef struct RayTask {
#ifdef PRELIGHT_SHADOWS
  Ray ray;  // as it was passed in
  const ShadowScene* scene;
  ShadowState shadow;
#else
  uint none;
#endif
} RayTask;

// Returns true when a ray ends where it meets a triangle.
PRELIGHT_INLINE bool endsRay(Surface surface, Hit hit, RayTask* task) {
#ifdef PRELIGHT_SHADOWS
  return !passesSurface(task->scene, surface, task->ray, hit, &task->shadow);
#else
  return surfaceIsThere(surface, hit.triangle, hit.u, hit.v);
#endif
}

// Tests the triangles of a leaf, whose indices start at `firstTriangle`, and accepts their hits.
void visitTriangles(Bvh bvh, Surface surface, uint leaf, uint firstTriangle, const PreparedRay* r, RayTask* task, Hit* best) {
  const uint first = leaf & PRELIGHT_LEAF_FIRST_MASK;
  const uint count = (leaf & ~PRELIGHT_LEAF_BIT) >> PRELIGHT_LEAF_COUNT_SHIFT;
  for (uint i = first; i < first + count; ++i) {
    Hit hit;
    if (!intersectTriangle(bvh.triangles + i, r, best->t, &hit.t, &hit.u, &hit.v)) continue;
    hit.triangle = bvh.triangles[i].triangle + firstTriangle;
    // The lower index wins between equal distances, whatever the order of visits.
    const bool nearer = hit.t < best->t || hit.triangle < best->triangle;
    if (!nearer || !endsRay(surface, hit, task)) continue;
#ifdef PRELIGHT_ANY_HIT
    const Hit any = {0.0f, 0u, 0.0f, 0.0f};
    *best = any;
    return;
#else
    *best = hit;
#endif
  }
}

// Returns the nearest hit of a ray with the scene or, with PRELIGHT_ANY_HIT, the first hit found that ends it, as
// triangle 0 without a distance. `surface` decides whether an alpha-masked hit counts.
Hit traceRay(Bvh bvh, Surface surface, Ray ray, RayTask* task) {
  PreparedRay r = prepareRay(ray);
  const Hit miss = {0.0f, PRELIGHT_NO_TRIANGLE, 0.0f, 0.0f};
  Hit best = miss;
  best.t = r.tMax;
  uint stack[PRELIGHT_STACK_SIZE];
  uint depth = 0;
  uint current = 0;
  uint firstTriangle = 0;  // index of the first triangle of the space in which the ray is
#ifdef PRELIGHT_INSTANCES
  uint floor = 0;  // an instance has been left when the stack is lower than this
#endif
  for (;;) {
#ifdef PRELIGHT_INSTANCES
    if (depth < floor) {
      r = prepareRay(ray);
      firstTriangle = 0;
      floor = 0;
    }
    if (isInstance(current)) {
      __global const DeviceInstance* instance = bvh.instances + (current & PRELIGHT_LEAF_FIRST_MASK);
      r = rayWithin(instance, ray);
      firstTriangle = instance->firstTriangle;
      floor = depth;
      current = instance->root;
    }
#endif
    if (current & PRELIGHT_LEAF_BIT) {
      visitTriangles(bvh, surface, current, firstTriangle, &r, task, &best);
#ifdef PRELIGHT_ANY_HIT
      if (best.triangle != PRELIGHT_NO_TRIANGLE) return best;
#endif
    } else {
      __global const NarrowNode* node = bvh.nodes + current;
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
