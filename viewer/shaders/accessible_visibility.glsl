// The visibility of a technique that knows how much of the sky is open and around which direction: a sky's lamps are seen through the cone that
// stands for it, other lamps are shadowed by the shells of near lamps alone; needs accessible_sky.glsl.
#include "lamp_shadow.glsl"

const bool isSender = false;
const bool shadowsSamples = false;

struct Visibility {
  OpenCone cone;
  float ofSky;
};

Visibility visibilityHere(vec3 n, Openness open) {
  OpenCone cone = noCone();  // no "?:", which WebGL has not for structures
  if (aoFilter == filterCone && dot(open.direction, open.direction) > 1e-12)
    cone = coneOfAccessibility(normalize(open.direction), open.accessibility);
  return Visibility(cone, open.accessibility);
}

float lampVisibility(Visibility seen, int k, Light light, vec3 toLight, float radius) {
  if (!isOfSky(light)) return 1.0;
  return seen.cone.there ? lampInCone(seen.cone, toLight, radius) : seen.ofSky;
}

float skyVisibility(Visibility seen, vec3 direction, float roughness) { return seen.ofSky; }

#include "sky_in_lobe.glsl"
