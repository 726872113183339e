// The light of vertices in an encoding. They have that of their fronts only; backs show the same.
#define KNOWS_BAKED_LOBES
#include "openness.glsl"
#include "encoded_light.glsl"

// The numbers of a point, of the unit normal n without bumps of the side that is seen.
EncodedPlace encodedHere(vec3 n) { return encodedOfVertices(triangleHere(), vPosition, gl_FrontFacing ? n : -n); }

// Backs have no light of their own.
bool knowsLobesHere() { return gl_FrontFacing; }

#include "encoded_visibility.glsl"

// Mean radiance that arrives about the normal n.
vec3 arrivingHere(vec3 n) {
  vec3 front = gl_FrontFacing ? n : -n;
  return irradianceOfEncoded(encodedOfVertices(triangleHere(), vPosition, front), front) / pi;
}

#include "openness_of_light.glsl"

vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 mapped = mappedNormal(side * n, vPosition, triangleHere(), vTexCoords);
  EncodedPlace place = encodedOfVertices(triangleHere(), vPosition, side * n);
  return partShown(partBaked, body.albedo / pi * irradianceOfEncoded(place, mapped));
}
