// Mean radiance that arrives about the normal n.
vec3 arrivingHere(vec3 n) { return bumpedIrradiance(gl_FrontFacing, n, n) / pi; }

#include "openness_of_light.glsl"

// Returns the radiance that a body scatters of a map's irradiance on both of its sides; needs bumpedIrradiance().
vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 mapped = mappedNormal(side * n, vPosition, triangleHere(), vTexCoords);
  mapped *= side;
  vec3 radiance = body.albedo / pi * bumpedIrradiance(gl_FrontFacing, n, mapped);
  if (hasTranslucency && translucency.a > 0.0) radiance += body.through / pi * bumpedIrradiance(!gl_FrontFacing, -n, -mapped);
  return partShown(partBaked, radiance);
}
