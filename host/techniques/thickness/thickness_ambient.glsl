// The light of an open sky, of which bodies let through the share that vertices have.
#define KNOWS_PASSAGE
vec3 passageHere() { return vTransferred; }
#include "accessible_sky.glsl"
#include "plain_openness.glsl"
#include "plain_visibility.glsl"

vec3 ambientRadiance(Body body, vec3 n, vec3 bumped, Openness open, Visibility seen) {
  return radianceUnderSky(body, bumped, open, open.accessibility, ambientAround(bumped));
}
