#version 410 core
// How open the backs of elements of disks.glsl are, a node a pixel; 1 for groups. Fronts occlude: what stands in the way of
// light to the back of one hides whatever it hides.
const float pi = 3.14159265358979;
#include "disks.glsl"

uniform int rowLength;

out vec4 outAccessibility;

void main() {
  int node = int(gl_FragCoord.x) + rowLength * int(gl_FragCoord.y);
  outAccessibility = vec4(1.0);
  if (node >= textureSize(disks) / 4 || texelFetch(disks, 4 * node + 3).w >= 0.0) return;
  vec3 back = -unitOf(texelFetch(disks, 4 * node + 1).xyz);
  outAccessibility.x = clamp(1.0 - blockedByDisks(texelFetch(disks, 4 * node).xyz, back).w, 0.0, 1.0);
}
