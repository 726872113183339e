#version 410 core
// The colour of a mark.
in vec3 markColor;

uniform vec2 shown;  // factor of colours, opacity

out vec4 outColor;

void main() { outColor = vec4(shown.x * markColor, shown.y); }
