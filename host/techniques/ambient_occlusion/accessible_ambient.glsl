// The sky around the bent normal, over the accessible share that vertices have.
#include "accessible_sky.glsl"
#include "accessible_visibility.glsl"

Openness opennessHere() {
  return Openness(passesKnownLight() && !gl_FrontFacing ? vReflected.x : vAccessibility,
                  gl_FrontFacing ? vBentNormal.xyz : vec3(0.0));
}

// How open the surface's other side is; where that is not known: as open as this one.
float opennessBeyond(Openness open) {
  if (!passesKnownLight()) return open.accessibility;
  return gl_FrontFacing ? vReflected.x : vAccessibility;
}

vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  return radianceUnderSky(body, bumped, open, opennessBeyond(open), accessibleSky(open, bumped));
}
