#version 410 core
// A photon as a point in the middle of the cell of the level that it falls into.
#include "frame.glsl"

layout(location = 0) in vec3 position;  // scene coordinates

uniform ivec4 cells;  // number in x and y, texels of a cell's side
uniform vec4 size;    // of the level, texels

void main() {
  vec4 clip = clipFromScene * vec4(position, 1.0);
  bool seen = clip.w > 0.0 && all(lessThanEqual(abs(clip.xyz), vec3(clip.w)));
  vec2 cell = floor((0.5 * clip.xy / clip.w + 0.5) * size.xy / float(cells.z));
  gl_Position = vec4(seen ? (2.0 * cell + 1.0) / vec2(cells.xy) - 1.0 : vec2(2.0), 0.0, 1.0);
}
