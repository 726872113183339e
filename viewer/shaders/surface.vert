#version 410 core
// One vertex of the scene.
#include "frame.glsl"
#include "vertex.glsl"
#include "lamp_visibility.glsl"

out vec3 vPosition;
out vec3 vNormal;
out vec4 vTexCoords;
out vec3 vOpenness;
out vec4 vColor;
out float vAccessibility;
out vec4 vBentNormal;
out vec3 vTransferred;
out vec3 vGlow;
out vec4 vChartCoord;
out vec3 vReflected;
out float vHighlight;

invariant gl_Position;  // programs with several fragment shaders draw the same places

void main() {
  Vertex vertex = readVertex();
  vPosition = vertex.position;
  vNormal = vertex.normal;
  vTexCoords = vertex.texCoords;
  vOpenness = vertex.openness;
  vColor = vertex.color;
  vAccessibility = vertex.accessibility;
  vBentNormal = vertex.bentNormal;
  vTransferred = max(vertex.radiance, vec3(0.0));
  vGlow = vertex.glow;
  vChartCoord = vertex.chartCoord;
  vReflected = vertex.reflected;
  vHighlight = vertex.highlight;
  passLampVisibility();
  gl_Position = clipFromScene * vec4(vertex.position, 1.0);
}
