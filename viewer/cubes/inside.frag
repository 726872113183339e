#version 410 core
// Normal (outwards) and distance of a body's surface.
uniform samplerBuffer triangleNormals;  // see RenderScene
uniform int firstTriangle;

in vec3 vWay;
in vec3 vNormal;

out vec4 outSurface;

void main() {
  vec4 triangle = texelFetch(triangleNormals, firstTriangle + gl_PrimitiveID);
  bool smoothShaded = triangle.w < 0.5 && dot(vNormal, vNormal) > 1e-12;
  outSurface = vec4(smoothShaded ? normalize(vNormal) : triangle.xyz, length(vWay));
}
