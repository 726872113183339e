// Watertight ray-triangle test: Woop, Benthin and Wald 2013, JCGT 2(1). Triangles are moved to the ray's origin and
// sheared so that the ray becomes the z axis; the signs of three edge functions then decide. An edge function of two
// triangles that share the edge is exactly antisymmetric as long as its products are rounded one by one, so
// contraction is off here. Zeros count as inside on both sides: a ray through an edge or vertex hits, never leaks.
// t is the mean of the corners' distances, weighted by the edge functions. Where corners lie both before and behind the
// origin and the weights are inaccurate, as in needles, that mean cancels: a surface behind the ray would be hit in
// front of it, and the ray would leak. There t comes from the plane instead, as long as it lies between the corners'
// distances.
#ifndef PRELIGHT_BVH_INTERSECT_FUNCS_CL
#define PRELIGHT_BVH_INTERSECT_FUNCS_CL

#include "shared/ray_types.h"

// Below this ratio of a triangle's doubled area to its squared extent, the weights have errors of about 2^-14 and more.
#define PRELIGHT_NEEDLE 0.0009765625f

// A ray prepared for the triangle and box tests.
typedef struct PreparedRay {
  float3 origin;
  float3 inverseDirection;  // finite, as components of the direction below 1e-20 of the largest are raised to that
  int kx, ky, kz;           // axes; kz is the dominant one
  float sx, sy, sz;         // shear
  float tMax;
  uint sourceTriangle;
} PreparedRay;

// Computes a b - c d to about an ulp, by Kahan's method: the normal of a needle is a small difference of large
// products.
#define PRELIGHT_DIFFERENCE_OF_PRODUCTS(a, b, c, d) (fma(a, b, -((c) * (d))) + fma(-(c), d, (c) * (d)))

float axisOf(float3 v, int axis) { return axis == 0 ? v.x : (axis == 1 ? v.y : v.z); }

float safeInverse(float d, float least) { return 1.0f / copysign(fmax(fabs(d), least), d); }

PreparedRay prepareRay(Ray ray) {
  PreparedRay r;
  const float3 d = (float3)(ray.direction[0], ray.direction[1], ray.direction[2]);
  const float3 size = fabs(d);
  r.origin = (float3)(ray.origin[0], ray.origin[1], ray.origin[2]);
  const float least = clamp(1e-20f * fmax(size.x, fmax(size.y, size.z)), 1e-37f, 1e18f);
  r.inverseDirection = (float3)(safeInverse(d.x, least), safeInverse(d.y, least), safeInverse(d.z, least));
  r.kz = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  r.kx = r.kz == 2 ? 0 : r.kz + 1;
  r.ky = r.kx == 2 ? 0 : r.kx + 1;
  const float dz = axisOf(d, r.kz);
  r.sx = axisOf(d, r.kx) / dz;
  r.sy = axisOf(d, r.ky) / dz;
  r.sz = 1.0f / dz;
  r.tMax = fmin(ray.tMax, MAXFLOAT);  // an infinite t, from a determinant near 0, is no hit
  r.sourceTriangle = ray.sourceTriangle;
  return r;
}

#endif
