// The cone that stands for the open share of the sky: about the bent normal, where there is one.
#include "openness.glsl"
#include "cones.glsl"
#include "lamp_shadow.glsl"

const bool isSender = false;
const bool shadowsSamples = false;

OpenCone openCone(vec3 n, Openness open) {
  vec3 axis = dot(open.direction, open.direction) > 1e-12 ? open.direction : gl_FrontFacing ? vBentNormal.xyz : vec3(0.0);
  axis = dot(axis, axis) > 1e-12 ? normalize(axis) : n;
  return coneOfAccessibility(axis, open.accessibility);
}
