// The light of vertices in an encoding. They have that of their fronts only; backs show the same.
#include "plain_openness.glsl"
#include "plain_visibility.glsl"
#include "encoded_light.glsl"

vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 mapped = mappedNormal(side * n, vPosition, triangleHere(), vTexCoords);
  return partShown(partBaked, body.albedo / pi * encodedVertexIrradiance(triangleHere(), vPosition, side * n, mapped));
}
