// The visibility where encoded light tells what arrives by direction; needs encodedHere().
#include "cone_visibility.glsl"

struct Visibility {
  OpenCone cone;
  vec3 normal;
  float ofSky;
  EncodedPlace light;
};

Visibility visibilityHere(vec3 n, Openness open) {
  return Visibility(openCone(n, open), n, open.accessibility, encodedHere(n));
}

#include "seen_in_cone.glsl"
#include "encoded_lobes.glsl"
