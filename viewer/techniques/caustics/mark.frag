#version 410 core
// Marks a pixel.
out vec4 outMark;

void main() { outMark = vec4(1.0); }
