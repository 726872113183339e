#version 410 core
// Light through baked transfer at a vertex: what is captured is the radiance before albedo.
#include "frame.glsl"
#include "variant.glsl"
#include "lights.glsl"
#include "sh_steps.glsl"
#include "transfer.glsl"

layout(location = 0) in vec3 position;

out vec3 transferred;

void main() {
  transferred = transferredLight(gl_VertexID, position);
  gl_Position = vec4(0.0);
}
