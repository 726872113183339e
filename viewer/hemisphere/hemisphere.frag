#version 410 core
// What a receiver sees: radiance, and 0 for what is open.
in vec3 vRadiance;

layout(location = 0) out vec4 seen;

void main() { seen = vec4(vRadiance, 0.0); }
