#version 410 core
// One colour over a picture.
uniform vec4 color;

out vec4 outColor;

void main() { outColor = color; }
