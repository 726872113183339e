// Intersection of a ray with the eight boxes of a node and with the eight triangles of a block.
#ifndef PRELIGHT_BVH_BLOCK_FUNCS_CL
#define PRELIGHT_BVH_BLOCK_FUNCS_CL

#include "transport/alpha_funcs.cl"
#include "bvh/group_funcs.cl"
#include "bvh/intersect_funcs.cl"

// The far end of a box grows by a few ulp (Ize 2013), so that rounding never loses it.
#define PRELIGHT_BOX_SLACK 1.0000004f

// Returns the lanes of the boxes that the ray meets in [0, tMax] and writes the distances at which it enters them.
PRELIGHT_INLINE int8 intersectBoxes(__global const WideNode* node, const RayGroup* g, uint lane, float tMax, float8* tNear) {
  __global const float* planes = (__global const float*)node;
  const uint opposite = 3u * PRELIGHT_WIDTH;
  const uint nx = g->entry[0][lane], ny = g->entry[1][lane], nz = g->entry[2][lane];
  const uint fx = nx < opposite ? nx + opposite : nx - opposite;
  const uint fy = ny < opposite ? ny + opposite : ny - opposite;
  const uint fz = nz < opposite ? nz + opposite : nz - opposite;
  const float8 ox = (float8)(g->origin[0][lane]), oy = (float8)(g->origin[1][lane]), oz = (float8)(g->origin[2][lane]);
  const float8 ix = (float8)(g->inverse[0][lane]), iy = (float8)(g->inverse[1][lane]), iz = (float8)(g->inverse[2][lane]);
  const float8 x0 = (vload8(0, planes + nx) - ox) * ix, x1 = (vload8(0, planes + fx) - ox) * ix;
  const float8 y0 = (vload8(0, planes + ny) - oy) * iy, y1 = (vload8(0, planes + fy) - oy) * iy;
  const float8 z0 = (vload8(0, planes + nz) - oz) * iz, z1 = (vload8(0, planes + fz) - oz) * iz;
  *tNear = most8(most8(x0, y0), most8(z0, (float8)(0.0f)));
  const float8 tFar = least8(least8(x1, y1), least8(z1, (float8)(tMax))) * PRELIGHT_BOX_SLACK;
  return *tNear <= tFar;
}

// Hits of a ray on the triangles of a block. Only the lanes of the mask that intersectBlock returns are defined.
typedef struct BlockHits {
  float t[PRELIGHT_WIDTH], u[PRELIGHT_WIDTH], v[PRELIGHT_WIDTH];
} BlockHits;

// Returns the distances to the planes of the eight triangles in units of the direction; NaN or infinite for triangles
// seen edge-on.
float8 planeDistances(__global const TriangleBlock* block, const RayGroup* g, uint lane) {
#pragma OPENCL FP_CONTRACT OFF
  const uint kx = g->axis[0][lane], ky = g->axis[1][lane], kz = g->axis[2][lane];
  const float8 ax = vload8(0, block->vertex[0][kx]), ay = vload8(0, block->vertex[0][ky]), az = vload8(0, block->vertex[0][kz]);
  const float8 bx = vload8(0, block->vertex[1][kx]) - ax, by = vload8(0, block->vertex[1][ky]) - ay, bz = vload8(0, block->vertex[1][kz]) - az;
  const float8 cx = vload8(0, block->vertex[2][kx]) - ax, cy = vload8(0, block->vertex[2][ky]) - ay, cz = vload8(0, block->vertex[2][kz]) - az;
  const float8 nx = PRELIGHT_DIFFERENCE_OF_PRODUCTS(by, cz, bz, cy);
  const float8 ny = PRELIGHT_DIFFERENCE_OF_PRODUCTS(bz, cx, bx, cz);
  const float8 nz = PRELIGHT_DIFFERENCE_OF_PRODUCTS(bx, cy, by, cx);
  const float8 height = nx * (ax - g->origin[kx][lane]) + ny * (ay - g->origin[ky][lane]) + nz * (az - g->origin[kz][lane]);
  return height / (nx * g->shear[0][lane] + ny * g->shear[1][lane] + nz) * g->shear[2][lane];
}

// Watertight ray-triangle test (Woop, Benthin and Wald 2013; see intersect_funcs.cl). Returns a mask whose set lanes
// are hits in [0, tMax] on triangles other than the source.
PRELIGHT_INLINE uint intersectBlock(__global const TriangleBlock* block, const RayGroup* g, uint lane, float tMax, BlockHits* hits) {
#pragma OPENCL FP_CONTRACT OFF
  const uint kx = g->axis[0][lane], ky = g->axis[1][lane], kz = g->axis[2][lane];
  const float8 ox = (float8)(g->origin[kx][lane]), oy = (float8)(g->origin[ky][lane]), oz = (float8)(g->origin[kz][lane]);
  const float8 sx = (float8)(g->shear[0][lane]), sy = (float8)(g->shear[1][lane]);
  const float8 az = vload8(0, block->vertex[0][kz]) - oz;
  const float8 bz = vload8(0, block->vertex[1][kz]) - oz;
  const float8 cz = vload8(0, block->vertex[2][kz]) - oz;
  const float8 ax = vload8(0, block->vertex[0][kx]) - ox - sx * az;
  const float8 ay = vload8(0, block->vertex[0][ky]) - oy - sy * az;
  const float8 bx = vload8(0, block->vertex[1][kx]) - ox - sx * bz;
  const float8 by = vload8(0, block->vertex[1][ky]) - oy - sy * bz;
  const float8 cx = vload8(0, block->vertex[2][kx]) - ox - sx * cz;
  const float8 cy = vload8(0, block->vertex[2][ky]) - oy - sy * cz;
  const float8 eu = cx * by - cy * bx;
  const float8 ev = ax * cy - ay * cx;
  const float8 ew = bx * ay - by * ax;
  const float8 zero = (float8)(0.0f);
  const float8 smallest = least8(least8(eu, ev), ew), largest = most8(most8(eu, ev), ew);
  const float8 determinant = eu + ev + ew;
  const int8 inside = ((smallest >= zero) | (largest <= zero)) & (determinant != zero);
  if (laneMask8(inside) == 0u) return 0u;
  const float8 inverse = 1.0f / determinant;
  float8 t = (eu * az + ev * bz + ew * cz) * g->shear[2][lane] * inverse;
  const float8 low = least8(least8(az, bz), cz), high = most8(most8(az, bz), cz);
  const int8 straddles = inside & (low < zero) & (high > zero);
  if (laneMask8(straddles) != 0u) {
    const float8 extent = fabs(ax) + fabs(bx) + fabs(cx) + fabs(ay) + fabs(by) + fabs(cy);
    const int8 cancels = straddles & (fabs(determinant) < PRELIGHT_NEEDLE * extent * (extent + high - low));
    if (laneMask8(cancels) != 0u) {
      const float8 plane = planeDistances(block, g, lane), first = low * g->shear[2][lane], last = high * g->shear[2][lane];
      t = select(t, plane, cancels & (plane >= least8(first, last)) & (plane <= most8(first, last)));
    }
  }
  const int8 hit = inside & (t >= zero) & (t <= tMax) & (as_int8(vload8(0, block->triangle)) != (int)g->source[lane]);
  const uint mask = laneMask8(hit);
  if (mask == 0u) return 0u;
  vstore8(t, 0, hits->t);
  vstore8(ev * inverse, 0, hits->u);
  vstore8(ew * inverse, 0, hits->v);
  return mask;
}

#ifdef PRELIGHT_ANY_HIT
// Shadow and any-hit rays: the first hit on an existing surface ends the ray, because nothing lies in [0, -1]. The
// result is triangle 0 and only says that there is a hit.
PRELIGHT_INLINE void acceptHits(Surface surface, __global const TriangleBlock* block, uint firstTriangle, uint mask, const BlockHits* found,
                                uint lane, HitGroup* hits) {
  while (mask != 0u) {
    const uint i = lowestLane(mask);
    mask &= mask - 1u;
#ifdef PRELIGHT_SHADOWS
    if (!shadowPasses(surface, block->triangle[i] + firstTriangle, found->t[i], found->u[i], found->v[i], lane, hits)) {
#else
    if (surfaceIsThere(surface, block->triangle[i] + firstTriangle, found->u[i], found->v[i])) {
#endif
      hits->triangle[lane] = 0u;
      hits->t[lane] = -1.0f;
      return;
    }
  }
}
#else
// Closest-hit rays: keeps the nearest hit on an existing surface. Between equal distances the lower index wins, whatever the
// order of visits.
PRELIGHT_INLINE void acceptHits(Surface surface, __global const TriangleBlock* block, uint firstTriangle, uint mask, const BlockHits* found,
                                uint lane, HitGroup* hits) {
  while (mask != 0u) {
    const uint i = lowestLane(mask);
    mask &= mask - 1u;
    const uint triangle = block->triangle[i] + firstTriangle;
    const float t = found->t[i];
    const bool nearer = t < hits->t[lane] || (t == hits->t[lane] && triangle < hits->triangle[lane]);
    if (nearer && surfaceIsThere(surface, triangle, found->u[i], found->v[i])) {
      hits->t[lane] = t;
      hits->triangle[lane] = triangle;
      hits->u[lane] = found->u[i];
      hits->v[lane] = found->v[i];
    }
  }
}
#endif

// Tests one ray of a group against a block, whose triangle indices start at `firstTriangle`, and accepts its hits.
PRELIGHT_INLINE void visitBlock(Surface surface, __global const TriangleBlock* block, uint firstTriangle, const RayGroup* g,
                                uint lane, HitGroup* hits) {
  BlockHits found;
  const uint mask = intersectBlock(block, g, lane, hits->t[lane], &found);
  if (mask != 0u) acceptHits(surface, block, firstTriangle, mask, &found, lane, hits);
}

#endif
