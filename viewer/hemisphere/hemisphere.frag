#version 410 core
// The view of a receiver: radiance, and 0 in open directions.
in vec3 vRadiance;

layout(location = 0) out vec4 seen;

void main() { seen = vec4(vRadiance, 0.0); }
