// Origins of rays that start on a surface: the exact place of a hit, a bound of its error, and an origin beyond that
// error.
// Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th ed., 6.8.
#ifndef PRELIGHT_CORE_OFFSET_FUNCS_CL
#define PRELIGHT_CORE_OFFSET_FUNCS_CL

// gamma(7) = 7 e / (1 - 7 e) with e = 2^-24: bounds the rounding of a sum of three products.
#define PRELIGHT_GAMMA_7 4.1723274e-7f

// Returns the point of a triangle with weights 1 - u - v, u, v. It is far closer to the triangle's plane than origin +
// t direction.
float3 pointOnTriangle(float3 a, float3 b, float3 c, float u, float v) {
  return (1.0f - u - v) * a + u * b + v * c;
}

// Returns a bound of each coordinate's error in pointOnTriangle.
float3 pointError(float3 a, float3 b, float3 c, float u, float v) {
  return PRELIGHT_GAMMA_7 * (fabs((1.0f - u - v) * a) + fabs(u * b) + fabs(v * c));
}

// Returns the next float beyond x in the direction of the sign of `way`, or x itself where `way` is 0.
float beyond(float x, float way) { return way == 0.0f ? x : nextafter(x, way > 0.0f ? MAXFLOAT : -MAXFLOAT); }

// Returns the origin of a ray that leaves `point` on the side of unit normal n to which `direction` points. No point
// within `error` of the surface lies ahead of it. In a plane through zero along the axes the error across it is 0, and
// the ray would start on neighbouring triangles, which it must not meet: hence the second bound.
float3 offsetOrigin(float3 point, float3 error, float3 n, float3 direction) {
  const float distance = fmax(dot(fabs(n), error), 1e-7f * fmax(error.x, fmax(error.y, error.z)));
  const float3 offset = dot(direction, n) < 0.0f ? -distance * n : distance * n;
  const float3 moved = point + offset;
  return (float3)(beyond(moved.x, offset.x), beyond(moved.y, offset.y), beyond(moved.z, offset.z));
}

#endif
