#version 410 core
// One vertex of the scene; with SH shading, light through its baked transfer, to be multiplied by the albedo.
#include "frame.glsl"
#include "lights.glsl"
#include "sh.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 texCoords;
layout(location = 3) in vec2 emissiveTexCoord;
layout(location = 4) in vec4 color;
layout(location = 5) in float accessibility;
layout(location = 6) in vec3 bentNormal;

uniform samplerBuffer transfer;  // see RenderScene

out vec3 vPosition;
out vec3 vNormal;
out vec4 vTexCoords;
out vec2 vEmissiveTexCoord;
out vec4 vColor;
out float vAccessibility;
out vec3 vBentNormal;
out vec3 vTransferred;

float windowOf(int band) { return window[band / 4][band % 4]; }

// Light coefficients at this vertex: the common ones, and the lights at finite distance.
void gatherLight(int order, out vec3 coefficients[maxCoefficients]) {
  for (int i = 0; i < order * order; ++i) coefficients[i] = transferLight[i].rgb;
  for (int k = 0; k < counts.x; ++k) {
    if (!isThroughTransfer(lights[k]) || kindOf(lights[k]) == kindDirectional) continue;
    vec3 toLight;
    vec3 irradiance = perpendicularIrradiance(lights[k], position, toLight);
    float basis[maxCoefficients];
    evaluateSh(toLight, order, basis);
    for (int l = 0; l < order; ++l) {
      for (int i = l * l; i < (l + 1) * (l + 1); ++i) coefficients[i] += windowOf(l) * basis[i] * irradiance;
    }
  }
}

void shadeThroughTransfer() {
  int order = counts.z;
  int channels = counts.w;
  int count = order * order;
  int texels = (count + 3) / 4;
  int base = gl_VertexID * channels * texels;
  vec3 light[maxCoefficients];
  gatherLight(order, light);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < count; ++i) {
    int texel = base + i / 4;
    vec3 t = vec3(texelFetch(transfer, texel)[i % 4]);
    if (channels == 3) {
      t.g = texelFetch(transfer, texel + texels)[i % 4];
      t.b = texelFetch(transfer, texel + 2 * texels)[i % 4];
    }
    sum += light[i] * t;
  }
  vTransferred = max(sum, vec3(0.0));  // a truncated series may dip below zero
  vAccessibility = clamp(texelFetch(transfer, base).x / 0.282094792, 0.0, 1.0);  // T_0 = Y_0 k_A
}

void main() {
  vPosition = position;
  vNormal = normal;
  vTexCoords = texCoords;
  vEmissiveTexCoord = emissiveTexCoord;
  vColor = color;
  vAccessibility = counts.y == shadingAo ? accessibility : 1.0;
  vBentNormal = bentNormal;
  vTransferred = vec3(0.0);
  if (counts.y == shadingSh) shadeThroughTransfer();
  gl_Position = clipFromScene * vec4(position, 1.0);
}
