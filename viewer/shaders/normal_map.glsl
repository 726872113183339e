// Normals that a texture bumps, as kernels/transport/interaction_funcs.cl has them; needs variant.glsl, material.glsl and
// triangles.glsl.
#include "core/dialect.h"
uniform sampler2D normalTexture;
uniform vec4 normalU;
uniform vec4 normalV;
uniform float normalScale;             // of the texture's x and y; 0: there is none
uniform TEXELS cornerTangents;  // [triangle][corner], w +-1

// Directions along and across the texture's u at a point of a triangle whose front's normal, without bumps, is n. False: the
// surface has none.
bool tangentsAt(vec3 n, vec3 point, int triangle, out vec3 x, out vec3 y) {
  vec3 w = weightsOfCorners(ivec3(FETCH(triangleCorners, triangle).xyz), point);
  vec4 first = FETCH(cornerTangents, 3 * triangle);
  vec3 tangent = w.x * first.xyz + w.y * FETCH(cornerTangents, 3 * triangle + 1).xyz +
                 w.z * FETCH(cornerTangents, 3 * triangle + 2).xyz;
  vec3 along = tangent - dot(tangent, n) * n;
  if (dot(along, along) <= 1e-12) return false;
  x = normalize(along);
  y = first.w * cross(n, x);
  return true;
}

// The normal as a texel of a normal texture turns it.
vec3 turnedNormal(vec3 n, vec3 texel, float scale, vec3 point, int triangle) {
  vec3 x, y;
  if (!tangentsAt(n, point, triangle, x, y)) return n;
  vec3 mapped = scale * (texel.x * x + texel.y * y) + texel.z * n;
  return dot(mapped, mapped) > 1e-12 ? normalize(mapped) : n;
}

// Unit normal of a front around its own, n, at a point of a triangle.
vec3 mappedNormal(vec3 n, vec3 point, int triangle, vec4 texCoords) {
  if (hasNormalTexture) {
    vec3 texel = 2.0 * texture(normalTexture, texturePlace(texCoords, normalU, normalV)).rgb - 1.0;
    if (normalScale != 0.0) return turnedNormal(n, texel, normalScale, point, triangle);
  }
  return n;
}

// The normal nearest to n about which the eye's direction is mirrored to above the triangle.
vec3 visibleNormal(vec3 n, vec3 geometric, vec3 toEye) {
  float rise = dot(toEye, geometric);
  float least = min(0.01, 0.9 * rise);
  if (rise <= 0.0 || (dot(n, toEye) > 0.0 && dot(2.0 * dot(n, toEye) * n - toEye, geometric) >= least)) return n;
  vec3 side = n - dot(n, geometric) * geometric;
  if (dot(side, side) <= 1e-12) return geometric;
  vec3 x = normalize(side);
  float along = dot(toEye, x);
  float angle = 0.5 * (atan(along, rise) + acos(min(least / sqrt(along * along + rise * rise), 1.0)));
  return normalize(sin(angle) * x + cos(angle) * geometric);
}

// The normal of the side that is seen, which diffuse light falls on; n is that of the surface without bumps, on the same side.
vec3 bumpedNormal(vec3 n, vec3 point, int triangle, vec4 texCoords) {
  if (hasNormalTexture) {
    float side = gl_FrontFacing ? 1.0 : -1.0;
    if (normalScale != 0.0) return side * mappedNormal(side * n, point, triangle, texCoords);
  }
  return n;
}

// Returns the normal of specular reflection: if a bump is hidden from the eye, that of its nearest visible slope.
vec3 reflectingNormal(vec3 bumped, vec3 geometric, vec3 toEye) {
  if (hasNormalTexture) {
    if (normalScale != 0.0) return visibleNormal(bumped, geometric, toEye);
  }
  return bumped;
}

// Normals of the side that is seen.
struct Normals {
  vec3 geometric;   // the triangle's
  vec3 bumped;      // bumpedNormal()
  vec3 reflecting;  // reflectingNormal()
};
