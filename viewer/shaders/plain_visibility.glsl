// The visibility of a technique that knows nothing of single directions.
#include "cone_visibility.glsl"

struct Visibility {
  OpenCone cone;
  vec3 normal;
  float ofSky;
};

Visibility visibilityHere(vec3 n, Openness open) { return Visibility(openCone(n, open), n, open.accessibility); }

#include "seen_in_cone.glsl"
