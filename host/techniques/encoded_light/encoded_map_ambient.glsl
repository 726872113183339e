// The light of a map in an encoding.
#define KNOWS_BAKED_LOBES
#include "openness.glsl"
#include "encoded_light.glsl"

// The numbers of a point's side, of a unit normal n without bumps.
EncodedPlace encodedHere(vec3 n) { return encodedOfMap(triangleHere(), gl_FrontFacing, vPosition, n); }

bool knowsLobesHere() { return hasLightMapPlace(triangleHere(), gl_FrontFacing); }

#include "encoded_visibility.glsl"

// Baked irradiance of a side where a normal map turns its unit normal n to m.
vec3 bumpedIrradiance(bool front, vec3 n, vec3 m) {
  return irradianceOfEncoded(encodedOfMap(triangleHere(), front, vPosition, n), m);
}

#include "mapped_ambient.glsl"
