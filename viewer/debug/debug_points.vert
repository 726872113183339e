#version 410 core
// A mark as a point.
#include "frame.glsl"
#include "debug_mark.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 color;

uniform float pointSize;  // samples

out vec3 markColor;

void main() {
  markColor = color;
  gl_Position = clipOfMark(position);
  gl_PointSize = pointSize;
}
