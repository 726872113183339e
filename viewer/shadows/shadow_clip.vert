#version 410 core
// A vertex as a light sees it, with the depth of shadows.glsl in clip space, which goes from 0 to 1.
#include "shadow_place.glsl"

void main() {
  vec3 p = placeSeen();
  gl_Position = axisY.w > 0.0 ? vec4(axisX.w * p.xy, axisY.w, p.z)
                              : vec4(axisX.w * p.xy, 0.5 - axisZ.w * p.z, 1.0);
}
