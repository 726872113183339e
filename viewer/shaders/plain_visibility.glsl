// The visibility of a technique that knows nothing of directions: one share of all the sky and its sun, and lamps that the shells of
// near lamps alone shadow.
#include "openness.glsl"
#include "lamp_shadow.glsl"

const bool isSender = false;
const bool shadowsSamples = false;

struct Visibility {
  float ofSky;
};

Visibility visibilityHere(vec3 n, Openness open) { return Visibility(open.accessibility); }

float lampVisibility(Visibility seen, int k, Light light, vec3 toLight, float radius) { return isSun(light) ? seen.ofSky : 1.0; }

float skyVisibility(Visibility seen, vec3 direction, float roughness) { return seen.ofSky; }

#include "sky_in_lobe.glsl"
