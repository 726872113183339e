#version 410 core
// A line as a strip of two triangles, an instance each: core profiles have no wide lines.
#include "frame.glsl"
#include "debug_mark.glsl"

layout(location = 0) in vec3 first;
layout(location = 1) in vec3 firstColor;
layout(location = 2) in vec3 second;
layout(location = 3) in vec3 secondColor;

uniform vec2 halfViewport;  // samples
uniform float halfWidth;    // samples
uniform float nearest;      // m, depth at which lines that pass the eye are cut

out vec3 markColor;

void main() {
  vec4 a = clipOfMark(first);
  vec4 b = clipOfMark(second);
  bool hidden = max(a.w, b.w) <= nearest && eye.w > 0.5;
  if (eye.w > 0.5 && !hidden) {
    if (a.w < nearest) a = mix(a, b, (nearest - a.w) / (b.w - a.w));
    if (b.w < nearest) b = mix(b, a, (nearest - b.w) / (a.w - b.w));
  }
  vec2 way = (b.xy / b.w - a.xy / a.w) * halfViewport;
  vec2 side = dot(way, way) > 1e-12 ? normalize(vec2(-way.y, way.x)) : vec2(0.0, 1.0);
  bool atSecond = gl_VertexID > 1;
  vec4 place = atSecond ? b : a;
  place.xy += (gl_VertexID % 2 == 0 ? halfWidth : -halfWidth) * side / halfViewport * place.w;
  gl_Position = hidden ? vec4(2.0, 2.0, 2.0, 1.0) : place;
  markColor = atSecond ? secondColor : firstColor;
}
