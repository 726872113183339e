#version 410 core
// A triangle that covers the picture, at the far plane; viewportPosition is -1..1 across the viewport.
out vec2 viewportPosition;

void main() {
  viewportPosition = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(viewportPosition, 1.0, 1.0);
}
