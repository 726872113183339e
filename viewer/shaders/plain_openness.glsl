// The openness that vertices have.
#include "openness.glsl"

Openness opennessHere() { return Openness(vAccessibility, vec3(0.0)); }
