// Sixteen rays prepared side by side for the box and triangle tests of the wide tree.
#ifndef PRELIGHT_BVH_GROUP_FUNCS_CL
#define PRELIGHT_BVH_GROUP_FUNCS_CL

#include "bvh/lane_funcs.cl"
#include "bvh/shadow_funcs.cl"
#include "shared/bvh_types.h"
#include "shared/ray_types.h"

// Rays of a group, [..][lane]. Lanes beyond the number of rays repeat the last ray, and their results are never read.
typedef struct RayGroup {
  float origin[3][PRELIGHT_GROUP];
  // Inverse of the direction; finite, because components below 1e-20 of the largest are raised to that.
  float inverse[3][PRELIGHT_GROUP];
  float shear[3][PRELIGHT_GROUP];    // Woop's Sx, Sy, Sz
  uint axis[3][PRELIGHT_GROUP];      // Woop's kx, ky, kz; kz the dominant one
  uint entry[3][PRELIGHT_GROUP];     // offset in a WideNode, in floats, of the planes through which the ray enters
  float tMax[PRELIGHT_GROUP];
  uint source[PRELIGHT_GROUP];
} RayGroup;

// Nearest hits of a group so far.
typedef struct HitGroup {
  float t[PRELIGHT_GROUP];  // tMax until there is a hit; -1 once any hit is enough
  uint triangle[PRELIGHT_GROUP];
  float u[PRELIGHT_GROUP];
  float v[PRELIGHT_GROUP];
#ifdef PRELIGHT_SHADOWS
  ShadowState shadows[PRELIGHT_GROUP];
  __global const Ray* rays;  // the group's rays as they were passed in
  const ShadowScene* scene;
#endif
} HitGroup;

float16 safeInverse16(float16 d, float16 least) { return 1.0f / copysign(most16(fabs(d), least), d); }

// Transposes 16 rows of one ray each (8 numbers) into 8 rows of one number each. Riffling all elements, first half with
// second, rotates the bits of their indices by one.
PRELIGHT_INLINE void transposeRays(float16 rows[8]) {
#pragma unroll
  for (uint turn = 0; turn < 4u; ++turn) {
    float16 from[8];
#pragma unroll
    for (uint i = 0; i < 8u; ++i) from[i] = rows[i];
#pragma unroll
    for (uint i = 0; i < 4u; ++i) {
      rows[2u * i] = riffledLow16(from[i], from[i + 4u]);
      rows[2u * i + 1u] = riffledHigh16(from[i], from[i + 4u]);
    }
  }
}

PRELIGHT_INLINE void loadGroup(__global const Ray* rays, uint count, RayGroup* g, float direction[3][PRELIGHT_GROUP]) {
  float16 rows[8];
#pragma unroll
  for (uint i = 0; i < 8u; ++i)
    rows[i] = (float16)(vload8(0, (__global const float*)(rays + min(2u * i, count - 1u))),
                        vload8(0, (__global const float*)(rays + min(2u * i + 1u, count - 1u))));
  transposeRays(rows);
#pragma unroll
  for (uint a = 0; a < 3; ++a) {
    vstore16(rows[a], 0, g->origin[a]);
    vstore16(rows[4u + a], 0, direction[a]);
  }
  vstore16(as_uint16(rows[3]), 0, g->source);
  vstore16(rows[7], 0, g->tMax);
  // An infinite t, from a determinant near 0, is no hit.
  vstore16(least16(vload16(0, g->tMax), (float16)(MAXFLOAT)), 0, g->tMax);
}

// Prepares shears and axes as intersect_funcs.cl does, for sixteen rays at once.
PRELIGHT_INLINE void prepareDirections(float16 x, float16 y, float16 z, RayGroup* g) {
  const int16 xIsLargest = (fabs(x) > fabs(y)) & (fabs(x) > fabs(z));
  const int16 yIsLargest = ~xIsLargest & (fabs(y) > fabs(z));
  const float16 dz = select(select(z, y, yIsLargest), x, xIsLargest);
  const float16 dx = select(select(x, z, yIsLargest), y, xIsLargest);
  const float16 dy = select(select(y, x, yIsLargest), z, xIsLargest);
  vstore16(dx / dz, 0, g->shear[0]);
  vstore16(dy / dz, 0, g->shear[1]);
  vstore16(1.0f / dz, 0, g->shear[2]);
  const int16 kz = select(select((int16)(2), (int16)(1), yIsLargest), (int16)(0), xIsLargest);
  vstore16(as_uint16(select(kz + 1, (int16)(0), kz == 2)), 0, g->axis[0]);
  vstore16(as_uint16(select(kz - 1, (int16)(2), kz == 0)), 0, g->axis[1]);
  vstore16(as_uint16(kz), 0, g->axis[2]);
  const float16 least = clamp(1e-20f * fabs(dz), 1e-37f, 1e18f);
  const float16 ix = safeInverse16(x, least), iy = safeInverse16(y, least), iz = safeInverse16(z, least);
  vstore16(ix, 0, g->inverse[0]);
  vstore16(iy, 0, g->inverse[1]);
  vstore16(iz, 0, g->inverse[2]);
  const uint16 lower = (uint16)(0u), upper = (uint16)(3u * PRELIGHT_WIDTH);
  vstore16(select(upper, lower, as_uint16(ix >= 0.0f)), 0, g->entry[0]);
  vstore16(select(upper, lower, as_uint16(iy >= 0.0f)) + PRELIGHT_WIDTH, 0, g->entry[1]);
  vstore16(select(upper, lower, as_uint16(iz >= 0.0f)) + 2u * PRELIGHT_WIDTH, 0, g->entry[2]);
}

PRELIGHT_INLINE void prepareGroup(__global const Ray* rays, uint count, RayGroup* g) {
  float direction[3][PRELIGHT_GROUP];
  loadGroup(rays, count, g, direction);
  prepareDirections(vload16(0, direction[0]), vload16(0, direction[1]), vload16(0, direction[2]), g);
}

void clearHits(const RayGroup* g, HitGroup* hits) {
  vstore16(vload16(0, g->tMax), 0, hits->t);
  vstore16((uint16)(PRELIGHT_NO_TRIANGLE), 0, hits->triangle);
  vstore16((float16)(0.0f), 0, hits->u);
  vstore16((float16)(0.0f), 0, hits->v);
}

#ifdef PRELIGHT_SHADOWS
void startShadows(__global const Ray* rays, const ShadowScene* scene, HitGroup* hits) {
  hits->rays = rays;
  hits->scene = scene;
  for (uint lane = 0; lane < PRELIGHT_GROUP; ++lane) startShadow(hits->shadows + lane);
}

// Accounts for the surface where a ray of the group meets a triangle. Returns false when no light passes.
PRELIGHT_INLINE bool shadowPasses(Surface surface, uint triangle, float t, float u, float v, uint lane, HitGroup* hits) {
  const Hit hit = {t, triangle, u, v};
  return passesSurface(hits->scene, surface, hits->rays[lane], hit, hits->shadows + lane);
}

// Writes the shadow results of the first `count` rays of a group.
PRELIGHT_INLINE void writeShadows(const HitGroup* found, uint count, __global Hit* hits) {
  const Hit blocked = {0.0f, 0u, 0.0f, 0.0f};
  for (uint lane = 0; lane < min(count, (uint)PRELIGHT_GROUP); ++lane)
    hits[lane] = found->triangle[lane] == PRELIGHT_NO_TRIANGLE ? shadowHit(found->shadows + lane) : blocked;
}
#endif

// Writes the first `count` of a group's hits.
PRELIGHT_INLINE void writeGroup(const HitGroup* found, uint count, __global Hit* hits) {
  const uint16 triangle = vload16(0, found->triangle);
#ifdef PRELIGHT_ANY_HIT
  const float16 t = (float16)(0.0f), u = t, v = t;
#else
  const float16 t = select(vload16(0, found->t), (float16)(0.0f), as_int16(triangle == PRELIGHT_NO_TRIANGLE));
  const float16 u = vload16(0, found->u), v = vload16(0, found->v);
#endif
  const float16 tu[2] = {riffledLow16(t, u), riffledHigh16(t, u)};
  const float16 iv[2] = {riffledLow16(as_float16(triangle), v), riffledHigh16(as_float16(triangle), v)};
  float all[4 * PRELIGHT_GROUP];
#pragma unroll
  for (uint i = 0; i < 2u; ++i) {
    vstore16(riffledLow16(tu[i], iv[i]), 2u * i, all);
    vstore16(riffledHigh16(tu[i], iv[i]), 2u * i + 1u, all);
  }
  if (count >= PRELIGHT_GROUP) {
#pragma unroll
    for (uint i = 0; i < 4u; ++i) vstore16(vload16(i, all), i, (__global float*)hits);
  } else {
    for (uint i = 0; i < count; ++i) vstore4(vload4(i, all), i, (__global float*)hits);
  }
}

#endif
