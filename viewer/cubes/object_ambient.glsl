// The light of objects that nothing was baked for, by the cube maps around them, which also tell what they reflect.
#include "plain_openness.glsl"
#include "surroundings.glsl"
#include "object_light.glsl"

const bool isSender = false;
const bool shadowsSamples = false;

struct Visibility {
  float ofSky;
};

// Cube maps know all that a lobe meets.
vec3 hiddenHere(vec3 n, float ofSky) { return vec3(0.0); }

Visibility visibilityHere(vec3 n, Openness open) { return Visibility(open.accessibility); }

float lampShadow(Light light) { return reachesNode(light, vPosition) ? 1.0 : 0.0; }

float lampVisibility(Visibility seen, int k, Light light, vec3 toLight, float radius) {
  return isOfSky(light) ? 0.0 : 1.0;  // the map has it
}

float skyVisibility(Visibility seen, vec3 direction, float roughness) { return seen.ofSky; }

vec3 radianceFrom(Visibility seen, vec3 direction, float roughness, float spread) {
  return surroundingRadiance(vPosition, direction, roughness);
}

vec3 radianceBehind(Visibility seen, vec3 direction, float roughness, out float known) {
  known = 1.0;
  return surroundingRadiance(vPosition, direction, roughness);
}

vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  vec3 radiance = body.albedo * (vTransferred + vOpenness * objectIrradiance(bumped));
  if (hasTranslucency && translucency.a > 0.0) radiance += body.through * vOpenness * objectIrradiance(-bumped);
  return partShown(partBaked, radiance);
}
