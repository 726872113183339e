#version 410 core
// A surface with holes whose depth is that of clip space.
#include "shadow_holes.glsl"

void main() {
  if (isHole()) discard;
}
