#version 410 core
// The sky behind the scene.
#include "frame.glsl"
#include "variant.glsl"
#include "sky.glsl"

uniform float emitted;  // factor of what is seen of the sky

in vec2 viewportPosition;
out vec4 outRadiance;

void main() {
  vec2 picture = viewportPosition * tile.xy + tile.zw;
  vec3 ray = forward.xyz;
  if (eye.w > 0.5) ray += picture.x * pixelRight.xyz + picture.y * pixelUp.xyz;
  outRadiance = vec4(emitted * skyRadiance(normalize(ray), skyLevels.y), 1e30);  // alpha: distance, of surroundings.glsl
}
