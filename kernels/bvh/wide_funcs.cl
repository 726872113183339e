// Traversal of the wide layout: one ray a work-item, eight boxes or triangles a vector instruction.
#ifndef PRELIGHT_BVH_WIDE_FUNCS_CL
#define PRELIGHT_BVH_WIDE_FUNCS_CL

#include "bvh/alpha_funcs.cl"
#include "bvh/intersect_funcs.cl"
#include "shared/bvh_types.h"

typedef struct Bvh {
  __global const WideNode* nodes;
  __global const TriangleBlock* triangles;
} Bvh;

// vminps/vmaxps: returns b when either is NaN, which cannot arise here (see safeInverse).
float8 least(float8 a, float8 b) { return select(b, a, a < b); }
float8 most(float8 a, float8 b) { return select(b, a, a > b); }

// Bit i set: lane i of the comparison is true.
uint laneMask(int8 lanes) {
  const int8 bits = lanes & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
  const int4 a = bits.lo | bits.hi;
  const int2 b = a.lo | a.hi;
  return (uint)(b.x | b.y);
}

// Entry distances of the eight boxes; returns the mask of those that the ray meets in [0, tMax].
// tFar grows by a few ulp (Ize 2013), so that rounding never loses a box.
uint intersectBoxes(__global const WideNode* node, const PreparedRay* r, float tMax, float8* tNear) {
  const float8 x0 = (vload8(0, r->inverseDirection.x >= 0.0f ? node->lower[0] : node->upper[0]) - r->origin.x) * r->inverseDirection.x;
  const float8 x1 = (vload8(0, r->inverseDirection.x >= 0.0f ? node->upper[0] : node->lower[0]) - r->origin.x) * r->inverseDirection.x;
  const float8 y0 = (vload8(0, r->inverseDirection.y >= 0.0f ? node->lower[1] : node->upper[1]) - r->origin.y) * r->inverseDirection.y;
  const float8 y1 = (vload8(0, r->inverseDirection.y >= 0.0f ? node->upper[1] : node->lower[1]) - r->origin.y) * r->inverseDirection.y;
  const float8 z0 = (vload8(0, r->inverseDirection.z >= 0.0f ? node->lower[2] : node->upper[2]) - r->origin.z) * r->inverseDirection.z;
  const float8 z1 = (vload8(0, r->inverseDirection.z >= 0.0f ? node->upper[2] : node->lower[2]) - r->origin.z) * r->inverseDirection.z;
  *tNear = most(most(x0, y0), most(z0, (float8)(0.0f)));
  const float8 tFar = least(least(x1, y1), least(z1, (float8)(tMax))) * 1.0000004f;
  return laneMask(*tNear <= tFar);
}

// Tests the eight triangles of a block. Lanes of the returned mask are hits in [0, tMax] that are not the source.
uint intersectTriangles(__global const TriangleBlock* block, const PreparedRay* r, float tMax, float8* t, float8* u, float8* v) {
#pragma OPENCL FP_CONTRACT OFF
  const float ox = axisOf(r->origin, r->kx), oy = axisOf(r->origin, r->ky), oz = axisOf(r->origin, r->kz);
  const float8 az = vload8(0, block->vertex[0][r->kz]) - oz;
  const float8 bz = vload8(0, block->vertex[1][r->kz]) - oz;
  const float8 cz = vload8(0, block->vertex[2][r->kz]) - oz;
  const float8 ax = vload8(0, block->vertex[0][r->kx]) - ox - r->sx * az;
  const float8 ay = vload8(0, block->vertex[0][r->ky]) - oy - r->sy * az;
  const float8 bx = vload8(0, block->vertex[1][r->kx]) - ox - r->sx * bz;
  const float8 by = vload8(0, block->vertex[1][r->ky]) - oy - r->sy * bz;
  const float8 cx = vload8(0, block->vertex[2][r->kx]) - ox - r->sx * cz;
  const float8 cy = vload8(0, block->vertex[2][r->ky]) - oy - r->sy * cz;
  const float8 eu = cx * by - cy * bx;
  const float8 ev = ax * cy - ay * cx;
  const float8 ew = bx * ay - by * ax;
  const float8 zero = (float8)(0.0f);
  const int8 inside = (eu >= zero & ev >= zero & ew >= zero) | (eu <= zero & ev <= zero & ew <= zero);
  const float8 determinant = eu + ev + ew;
  int8 hit = inside & (determinant != zero);
  if (!any(hit)) return 0u;
  const float8 inverse = 1.0f / determinant;
  *u = ev * inverse;
  *v = ew * inverse;
  *t = (eu * az + ev * bz + ew * cz) * r->sz * inverse;
  hit &= (*t >= zero) & (*t <= tMax) & (as_int8(vload8(0, block->triangle)) != (int)r->sourceTriangle);
  return laneMask(hit);
}

// Nearest hit of a ray with the scene. `surface` decides whether an alpha-masked hit counts.
Hit traceClosest(Bvh bvh, Surface surface, Ray ray) {
  PreparedRay r = prepareRay(ray);
  Hit best = {r.tMax, PRELIGHT_NO_TRIANGLE, 0.0f, 0.0f};
  uint stackChild[PRELIGHT_STACK_SIZE];
  float stackNear[PRELIGHT_STACK_SIZE];
  uint depth = 0;
  uint current = 0;  // the root is node 0
  for (;;) {
    if (current & PRELIGHT_LEAF_BIT) {
      __global const TriangleBlock* block = bvh.triangles + (current & ~PRELIGHT_LEAF_BIT);
      float8 t8, u8, v8;
      uint mask = intersectTriangles(block, &r, best.t, &t8, &u8, &v8);
      if (mask != 0u) {
        float t[PRELIGHT_WIDTH], u[PRELIGHT_WIDTH], v[PRELIGHT_WIDTH];
        vstore8(t8, 0, t);
        vstore8(u8, 0, u);
        vstore8(v8, 0, v);
        while (mask != 0u) {
          const uint lane = 31u - clz(mask);
          mask ^= 1u << lane;
          const uint triangle = block->triangle[lane];
          // Equal distances go to the lower index, whatever the order of visits.
          const bool nearer = t[lane] < best.t || (t[lane] == best.t && triangle < best.triangle);
          if (nearer && surfaceIsThere(surface, triangle, u[lane], v[lane])) {
            best.t = t[lane];
            best.triangle = triangle;
            best.u = u[lane];
            best.v = v[lane];
          }
        }
      }
    } else {
      __global const WideNode* node = bvh.nodes + current;
      float8 near8;
      uint mask = intersectBoxes(node, &r, best.t, &near8);
      if (mask != 0u) {
        float near[PRELIGHT_WIDTH];
        vstore8(near8, 0, near);
        uint lane = 31u - clz(mask);
        mask ^= 1u << lane;
        current = node->child[lane];
        if (mask == 0u) continue;
        // Descend into the nearest; the others go on the stack, nearest on top.
        const uint first = depth;
        float currentNear = near[lane];
        while (mask != 0u) {
          lane = 31u - clz(mask);
          mask ^= 1u << lane;
          uint child = node->child[lane];
          float distance = near[lane];
          if (distance < currentNear) {
            const uint c = current;
            const float d = currentNear;
            current = child;
            currentNear = distance;
            child = c;
            distance = d;
          }
          uint at = depth++;
          while (at > first && stackNear[at - 1] < distance) {
            stackNear[at] = stackNear[at - 1];
            stackChild[at] = stackChild[at - 1];
            --at;
          }
          stackNear[at] = distance;
          stackChild[at] = child;
        }
        continue;
      }
    }
    // Next of the stack that is not beyond the nearest hit.
    for (;;) {
      if (depth == 0) {
        if (best.triangle == PRELIGHT_NO_TRIANGLE) best.t = 0.0f;
        return best;
      }
      --depth;
      if (stackNear[depth] <= best.t * 1.0000004f) break;
    }
    current = stackChild[depth];
  }
}

// True when anything is hit. No order is kept: any hit ends the search.
bool traceAny(Bvh bvh, Surface surface, Ray ray) {
  PreparedRay r = prepareRay(ray);
  uint stack[PRELIGHT_STACK_SIZE];
  uint depth = 0;
  uint current = 0;
  for (;;) {
    if (current & PRELIGHT_LEAF_BIT) {
      __global const TriangleBlock* block = bvh.triangles + (current & ~PRELIGHT_LEAF_BIT);
      float8 t8, u8, v8;
      uint mask = intersectTriangles(block, &r, r.tMax, &t8, &u8, &v8);
#ifdef PRELIGHT_ALPHA_TEST
      float u[PRELIGHT_WIDTH], v[PRELIGHT_WIDTH];
      vstore8(u8, 0, u);
      vstore8(v8, 0, v);
      while (mask != 0u) {
        const uint lane = 31u - clz(mask);
        mask ^= 1u << lane;
        if (surfaceIsThere(surface, block->triangle[lane], u[lane], v[lane])) return true;
      }
#else
      if (mask != 0u) return true;
#endif
    } else {
      __global const WideNode* node = bvh.nodes + current;
      float8 near8;
      uint mask = intersectBoxes(node, &r, r.tMax, &near8);
      while (mask != 0u) {
        const uint lane = 31u - clz(mask);
        mask ^= 1u << lane;
        stack[depth++] = node->child[lane];
      }
    }
    if (depth == 0) return false;
    current = stack[--depth];
  }
}

#endif
