#version 410 core
// A vertex as a light sees it, whose depth shadow.frag computes.
#include "shadow_place.glsl"

void main() {
  vec3 p = placeSeen();
  gl_Position = axisY.w > 0.0 ? vec4(axisX.w * p.xy, p.z - 2.0 * axisY.w, p.z)
                              : vec4(axisX.w * p.xy, 2.0 * axisZ.w * p.z, 1.0);
}
