// The triangles of the scene and places on them.
#include "core/dialect.h"
uniform UTEXELS triangleCorners;  // [triangle], vertices
uniform TEXELS cornerPositions;   // [vertex]

// Weights of a triangle's corners at a point in its plane.
vec3 barycentric(vec3 point, vec3 a, vec3 b, vec3 c) {
  vec3 ab = b - a;
  vec3 ac = c - a;
  vec3 normal = cross(ab, ac);
  float scale = 1.0 / max(dot(normal, normal), 1e-30);
  float wb = dot(cross(point - a, ac), normal) * scale;
  float wc = dot(cross(ab, point - a), normal) * scale;
  return vec3(1.0 - wb - wc, wb, wc);
}

vec3 weightsOfCorners(ivec3 corners, vec3 point) {
  return barycentric(point, FETCH(cornerPositions, corners.x).xyz, FETCH(cornerPositions, corners.y).xyz,
                     FETCH(cornerPositions, corners.z).xyz);
}
