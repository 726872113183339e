#version 410 core
// Depth as shadows.glsl has it: greater is nearer, affine across a plane, and as precise far away as near.
#include "shadow_holes.glsl"

uniform vec4 axisY;  // w: nearest depth, m; 0: orthographic

void main() {
  if (isHole()) discard;
  gl_FragDepth = axisY.w > 0.0 ? axisY.w * gl_FragCoord.w : 1.0 - gl_FragCoord.z;
}
