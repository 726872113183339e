// The sky through the cone about the bent normal, which shadows lamps and reflections, too. Backs have none.
#include "accessible_sky.glsl"
#include "plain_openness.glsl"
#include "lamp_shadow.glsl"

const bool isSender = false;
const bool shadowsSamples = true;

// The cone, built once per fragment for all lamps.
struct Visibility {
  OpenCone cone;
  vec3 normal;
  float ofSky;  // where there is no cone
};

Visibility visibilityHere(vec3 n, Openness open) {
  if (!gl_FrontFacing || dot(vBentNormal.xyz, vBentNormal.xyz) <= 1e-12) return Visibility(noCone(), n, open.accessibility);
  return Visibility(coneAround(normalize(vBentNormal.xyz), clamp(vBentNormal.w, 0.0, 1.0), vAccessibility), n, open.accessibility);
}

float lampVisibility(Visibility seen, int k, Light light, vec3 toLight, float radius) {
  if (seen.cone.there) return lampInCone(seen.cone, toLight, radius);
  return isOfSky(light) ? seen.ofSky : 1.0;
}

float skyVisibility(Visibility seen, vec3 direction, float roughness) {
  return seen.cone.there ? openShareOfLobe(seen.cone, seen.normal, roughness, direction) : seen.ofSky;
}

#include "sky_in_lobe.glsl"

vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  vec3 sky = seen.cone.there ? skyInCone(seen.cone) : ambientAround(bumped);
  return radianceUnderSky(body, bumped, open, open.accessibility, sky);
}
