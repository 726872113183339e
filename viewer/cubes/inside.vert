#version 410 core
// A vertex of a body of glass as seen from its middle.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

uniform mat4 clipFromScene;
uniform vec3 center;

out vec3 vWay;
out vec3 vNormal;

void main() {
  vWay = position - center;
  vNormal = normal;
  gl_Position = clipFromScene * vec4(position, 1.0);
}
