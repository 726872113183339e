// The visibility of a technique that knows nothing of single directions: the open share of the sky is taken for a cone about the
// bent normal, where there is one, suns have the share of all the sky, and only the shells of near lamps shadow lamps.
#include "openness.glsl"
#include "cones.glsl"
#include "lamp_shadow.glsl"

const bool isSender = false;
const bool shadowsSamples = false;

struct Visibility {
  OpenCone cone;
  vec3 normal;
  float ofSky;
};

Visibility visibilityHere(vec3 n, Openness open) {
  vec3 axis = dot(open.direction, open.direction) > 1e-12 ? open.direction : gl_FrontFacing ? vBentNormal.xyz : vec3(0.0);
  axis = dot(axis, axis) > 1e-12 ? normalize(axis) : n;
  return Visibility(coneOfAccessibility(axis, open.accessibility), n, open.accessibility);
}

float lampVisibility(Visibility seen, int k, Light light, vec3 toLight, float radius) { return isOfSky(light) ? seen.ofSky : 1.0; }

float skyVisibility(Visibility seen, vec3 direction, float roughness) {
  return openShareOfLobe(seen.cone, seen.normal, roughness, direction);
}

#include "sky_in_lobe.glsl"
