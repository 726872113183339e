#version 410 core
// One vertex of the scene.
#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 texCoords;  // the file's two sets
layout(location = 3) in vec3 openness;
layout(location = 4) in vec4 color;
layout(location = 5) in float accessibility;
layout(location = 6) in vec4 bentNormal;
layout(location = 7) in vec3 radiance;
layout(location = 8) in vec3 glow;
layout(location = 9) in vec4 chartCoord;
layout(location = 10) in vec3 reflected;  // or what arrives on the other side
layout(location = 11) in float highlight;
layout(location = 12) in vec4 lampVisibility[4];

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
out vec4 vLampVisibility[4];

invariant gl_Position;  // programs with several fragment shaders draw the same places

void main() {
  vPosition = position;
  vNormal = normal;
  vTexCoords = texCoords;
  vOpenness = openness;
  vColor = color;
  vAccessibility = accessibility;
  vBentNormal = bentNormal;
  vTransferred = max(radiance, vec3(0.0));
  vGlow = glow;
  vChartCoord = chartCoord;
  vReflected = reflected;
  vHighlight = highlight;
  vLampVisibility = lampVisibility;
  gl_Position = clipFromScene * vec4(position, 1.0);
}
