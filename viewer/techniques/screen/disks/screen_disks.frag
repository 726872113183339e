#version 410 core
// Accessibility of a pixel among the surfaces of the scene, seen or not.
#include "frame.glsl"
#include "screen_space.glsl"
#include "disks.glsl"

out vec4 outOpenness;  // xyz: mean open direction, scene; w: accessibility

void main() {
  Seen here = seenIn(firstLayer, pixelHere());
  outOpenness = vec4(0.0, 0.0, 0.0, 1.0);
  if (!here.there) return;
  vec3 n = normalize(toScene(here.normal));
  vec4 blocked = blockedByDisks(eye.xyz + toScene(here.place), n);
  // The mean direction of an open hemisphere, weighted by the cosine, is 2/3 n.
  outOpenness = vec4(unitOf(2.0 / 3.0 * n - blocked.xyz), clamp(1.0 - blocked.w, 0.0, 1.0));
}
