// The light of vertices in an encoding. They have that of their fronts only; backs show the same.
#include "openness.glsl"
#include "plain_visibility.glsl"
#include "encoded_light.glsl"

// Mean radiance that arrives about the normal n.
vec3 arrivingHere(vec3 n) {
  vec3 front = gl_FrontFacing ? n : -n;
  return encodedVertexIrradiance(triangleHere(), vPosition, front, front) / pi;
}

#include "openness_of_light.glsl"

vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 mapped = mappedNormal(side * n, vPosition, triangleHere(), vTexCoords);
  return partShown(partBaked, body.albedo / pi * encodedVertexIrradiance(triangleHere(), vPosition, side * n, mapped));
}
