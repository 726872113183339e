#version 410 core
// Light through baked transfer at a vertex: what is captured is the radiance before albedo.
#include "frame.glsl"
#include "variant.glsl"
#include "lights.glsl"
#include "sh_steps.glsl"
#include "transfer.glsl"

#ifdef GL_ES
uniform TEXELS cornerPositions;  // [vertex]
uniform TEXELS vertexNormals;    // [vertex]
uniform int pointsAVertex;       // rows of numbers: one, two of fronts and other sides, or those of a matrix
vec3 placeOfVertex() { return FETCH(cornerPositions, gl_VertexID / pointsAVertex).xyz; }
vec3 normalOfVertex() { return FETCH(vertexNormals, gl_VertexID / pointsAVertex).xyz; }
int whatRowIs() { return gl_VertexID % pointsAVertex == 0 ? rowOfFront : pointsAVertex == 2 ? rowBehind : rowOfMatrix; }
out vec4 transferred;  // a texel: what graphics cards copy; it is mixed, and then kept from below zero
void keep(vec3 light) { transferred = vec4(light, 1.0); }
#else
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform int transferRows;  // TransferRow of all rows
vec3 placeOfVertex() { return position; }
vec3 normalOfVertex() { return normal; }
int whatRowIs() { return transferRows; }
out vec3 transferred;
void keep(vec3 light) { transferred = max(light, vec3(0.0)); }
#endif

void main() {
  keep(transferredLight(gl_VertexID, placeOfVertex(), normalOfVertex(), whatRowIs()));
  gl_Position = vec4(0.0);
}
