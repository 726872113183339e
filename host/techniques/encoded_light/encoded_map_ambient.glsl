// The light of a map in an encoding.
#include "openness.glsl"
#include "plain_visibility.glsl"
#include "encoded_light.glsl"

// Baked irradiance of a side where a normal map turns its unit normal n to m.
vec3 bumpedIrradiance(bool front, vec3 n, vec3 m) { return encodedMapIrradiance(triangleHere(), front, vPosition, n, m); }

#include "mapped_ambient.glsl"
