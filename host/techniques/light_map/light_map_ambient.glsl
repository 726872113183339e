// The irradiance of a light map.
#include "openness.glsl"
#include "plain_visibility.glsl"
#include "light_map.glsl"

// Baked irradiance of a side where a normal map turns its unit normal n to m.
vec3 bumpedIrradiance(bool front, vec3 n, vec3 m) {
  int triangle = triangleHere();
  if (!hasNormalTexture) return lightMapIrradiance(triangle, front, vPosition);
  return mappedLightMapIrradiance(triangle, front, vPosition, n, m);
}

#include "mapped_ambient.glsl"
