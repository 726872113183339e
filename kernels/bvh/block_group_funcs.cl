// Intersection of rays that leave one point with the triangles of a block: one triangle after the other, each against
// all rays at once. Formula and order of operations are those of block_funcs.cl, so the hits are identical.
#ifndef PRELIGHT_BVH_BLOCK_GROUP_FUNCS_CL
#define PRELIGHT_BVH_BLOCK_GROUP_FUNCS_CL

#include "bvh/block_funcs.cl"

// Corners of a block's triangles relative to the origin of the rays, [corner][kx, ky, kz][lane].
typedef struct RelativeBlock {
  float corner[3][3][PRELIGHT_WIDTH];
} RelativeBlock;

PRELIGHT_INLINE void relateBlock(__global const TriangleBlock* block, const RayGroup* g, const uint axis[3], RelativeBlock* relative) {
#pragma unroll
  for (uint c = 0; c < 3u; ++c)
#pragma unroll
    for (uint a = 0; a < 3u; ++a)
      vstore8(vload8(0, block->vertex[c][axis[a]]) - (float8)(g->origin[axis[a]][0]), 0, relative->corner[c][a]);
}

// Hits of sixteen rays on one triangle.
typedef struct TriangleHits {
  float16 t, u, v;
} TriangleHits;

// A triangle sheared into the space in which the rays are the z axis, and its edge functions, per ray.
typedef struct ShearedTriangle {
  float16 ax, ay, bx, by, cx, cy;
  float16 eu, ev, ew;
} ShearedTriangle;

PRELIGHT_INLINE ShearedTriangle shearTriangle(const RelativeBlock* block, uint i, const RayGroup* g) {
#pragma OPENCL FP_CONTRACT OFF
  const float16 sx = vload16(0, g->shear[0]), sy = vload16(0, g->shear[1]);
  const float az = block->corner[0][2][i], bz = block->corner[1][2][i], cz = block->corner[2][2][i];
  ShearedTriangle s;
  s.ax = (float16)(block->corner[0][0][i]) - sx * az, s.ay = (float16)(block->corner[0][1][i]) - sy * az;
  s.bx = (float16)(block->corner[1][0][i]) - sx * bz, s.by = (float16)(block->corner[1][1][i]) - sy * bz;
  s.cx = (float16)(block->corner[2][0][i]) - sx * cz, s.cy = (float16)(block->corner[2][1][i]) - sy * cz;
  s.eu = s.cx * s.by - s.cy * s.bx;
  s.ev = s.ax * s.cy - s.ay * s.cx;
  s.ew = s.bx * s.ay - s.by * s.ax;
  return s;
}

// Returns true in the lanes of rays whose lines pass through the triangle.
PRELIGHT_INLINE int16 isInside(const ShearedTriangle* s) {
  const float16 zero = (float16)(0.0f);
  const float16 smallest = least16(least16(s->eu, s->ev), s->ew), largest = most16(most16(s->eu, s->ev), s->ew);
  return (smallest >= zero) | (largest <= zero);
}

// Returns the mask of the triangles through which lines of the given rays pass. It has no branches, because a branch
// per triangle would be mispredicted.
PRELIGHT_INLINE uint trianglesInside(const RelativeBlock* block, uint count, const RayGroup* g, int16 rays) {
  uint inside = 0u;
  for (uint i = 0; i < count; ++i) {
    const ShearedTriangle s = shearTriangle(block, i, g);
    inside |= (laneMask16(isInside(&s) & rays) != 0u ? 1u : 0u) << i;
  }
  return inside;
}

// Returns the lanes of the rays that hit a triangle in [0, tMax]. Rays that need the distance to its plane instead are
// left out and marked in `needles`.
PRELIGHT_INLINE int16 intersectTriangle(const RelativeBlock* block, uint i, const RayGroup* g, int16 rays, float16 tMax,
                                        TriangleHits* hits, uint* needles) {
#pragma OPENCL FP_CONTRACT OFF
  const float16 zero = (float16)(0.0f);
  const float az = block->corner[0][2][i], bz = block->corner[1][2][i], cz = block->corner[2][2][i];
  const ShearedTriangle s = shearTriangle(block, i, g);
  const float16 determinant = s.eu + s.ev + s.ew;
  int16 hit = isInside(&s) & (determinant != zero) & rays;
  const float16 inverse = 1.0f / determinant;
  hits->t = (s.eu * az + s.ev * bz + s.ew * cz) * vload16(0, g->shear[2]) * inverse;
  hits->u = s.ev * inverse;
  hits->v = s.ew * inverse;
  const float lowAb = az < bz ? az : bz, highAb = az > bz ? az : bz;
  const float low = lowAb < cz ? lowAb : cz, high = highAb > cz ? highAb : cz;
  if (low < 0.0f && high > 0.0f) {
    const float16 extent = fabs(s.ax) + fabs(s.bx) + fabs(s.cx) + fabs(s.ay) + fabs(s.by) + fabs(s.cy);
    const int16 cancels = hit & (fabs(determinant) < PRELIGHT_NEEDLE * extent * (extent + high - low));
    *needles |= laneMask16(cancels);
    hit &= ~cancels;
  }
  return hit & (hits->t >= zero) & (hits->t <= tMax);
}

// Returns `hit` without the lanes whose hits fall into holes of an alpha mask.
PRELIGHT_INLINE int16 whereSurfaceIs(Surface surface, uint triangle, const TriangleHits* found, int16 hit) {
#ifdef PRELIGHT_ALPHA_TEST
  float u[PRELIGHT_GROUP], v[PRELIGHT_GROUP];
  int there[PRELIGHT_GROUP];
  vstore16(found->u, 0, u);
  vstore16(found->v, 0, v);
  vstore16((int16)(0), 0, there);
  for (uint mask = laneMask16(hit); mask != 0u; mask &= mask - 1u) {
    const uint lane = lowestLane(mask);
    there[lane] = surfaceIsThere(surface, triangle, u[lane], v[lane]) ? -1 : 0;
  }
  return hit & vload16(0, there);
#else
  return hit;
#endif
}

// Accepts the hits of up to sixteen rays on one triangle, as acceptHits does for one ray.
PRELIGHT_INLINE void acceptTogether(Surface surface, uint triangle, int16 hit, const TriangleHits* found, HitGroup* hits) {
  const float16 t = vload16(0, hits->t);
  const uint16 old = vload16(0, hits->triangle);
#ifndef PRELIGHT_ANY_HIT
  hit &= (found->t < t) | (old > (uint16)(triangle));
#endif
  if (laneMask16(hit) == 0u) return;
  hit = whereSurfaceIs(surface, triangle, found, hit);
#ifdef PRELIGHT_ANY_HIT
  vstore16(select(t, (float16)(-1.0f), hit), 0, hits->t);
  vstore16(select(old, (uint16)(0u), as_uint16(hit)), 0, hits->triangle);
#else
  vstore16(select(t, found->t, hit), 0, hits->t);
  vstore16(select(old, (uint16)(triangle), as_uint16(hit)), 0, hits->triangle);
  vstore16(select(vload16(0, hits->u), found->u, hit), 0, hits->u);
  vstore16(select(vload16(0, hits->v), found->v, hit), 0, hits->v);
#endif
}

// Tests the rays of a group whose dominant axis is kz against a block, as visitBlock does for one ray. `mask`: the rays
// among them that may hit something.
PRELIGHT_INLINE void visitBlockTogether(Surface surface, __global const TriangleBlock* block, uint firstTriangle, const RayGroup* g,
                                        uint mask, uint kz, HitGroup* hits) {
  const uint kx = kz == 2u ? 0u : kz + 1u, ky = kx == 2u ? 0u : kx + 1u;
  const uint axis[3] = {kx, ky, kz};
  RelativeBlock relative;
  relateBlock(block, g, axis, &relative);
  const int16 rays = vload16(0, g->axis[2]) == kz;
  const uint16 source = vload16(0, g->source);
  uint needles = 0u;
  const uint used = popcount(laneMask8(as_int8(vload8(0, block->triangle) != PRELIGHT_NO_TRIANGLE)));
  for (uint inside = trianglesInside(&relative, used, g, rays); inside != 0u; inside &= inside - 1u) {
    const uint i = lowestLane(inside);
    const uint triangle = block->triangle[i];
    TriangleHits found;
    const int16 hit = intersectTriangle(&relative, i, g, rays & (source != triangle), vload16(0, hits->t), &found, &needles);
    if (laneMask16(hit) != 0u) acceptTogether(surface, triangle + firstTriangle, hit, &found, hits);
  }
  for (needles &= mask; needles != 0u; needles &= needles - 1u)
    visitBlock(surface, block, firstTriangle, g, lowestLane(needles), hits);
}

#endif
