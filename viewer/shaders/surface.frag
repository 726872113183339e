#version 410 core
// A surface in one of the shadings. Approximations, so that nothing looks dead or wrong:
// - metals have no diffuse albedo: they reflect lights (unshadowed) and the sky, attenuated by the accessibility;
// - transmissive surfaces are thin: what lies behind shows straight through, tinted, and they reflect the sky;
// - in SH shading, lights that the transfer cannot see rightly (viewer/lighting.h) shine without shadows.
#include "frame.glsl"
#include "lights.glsl"
#include "material.glsl"
#include "specular.glsl"
#include "sky.glsl"

in vec3 vPosition;
in vec3 vNormal;
in vec4 vTexCoords;
in vec2 vEmissiveTexCoord;
in vec4 vColor;
in float vAccessibility;
in vec3 vBentNormal;
in vec3 vTransferred;

layout(location = 0, index = 0) out vec4 outRadiance;
layout(location = 0, index = 1) out vec4 outTransmitted;  // factor of what lies behind

vec3 shadingNormal() {
  vec4 triangle = texelFetch(triangleNormals, firstTriangle + gl_PrimitiveID);
  bool usable = triangle.w < 0.5 && dot(vNormal, vNormal) > 1e-12;
  vec3 n = usable ? normalize(vNormal) : triangle.xyz;
  return gl_FrontFacing ? n : -n;
}

// Light of all lights that do not come through the transfer; specular reflections of all.
vec3 shadeLights(FragmentMaterial m, vec3 n, vec3 toEye, float specularWeight) {
  vec3 sum = vec3(0.0);
  for (int k = 0; k < counts.x; ++k) {
    vec3 toLight;
    vec3 irradiance = perpendicularIrradiance(lights[k], vPosition, toLight) * max(dot(n, toLight), 0.0);
    bool transferred = counts.y == shadingSh && isThroughTransfer(lights[k]);
    if (!transferred) sum += irradiance * m.albedo / pi;
    if (specularWeight > 0.0) {
      sum += irradiance * specularWeight * specularBrdf(m.f0, m.roughness, n, toEye, toLight);
    }
  }
  return sum;
}

vec3 shadeAmbient(FragmentMaterial m, vec3 n) {
  if (counts.y == shadingSh) return m.albedo * vTransferred;
  vec3 around = n;
  if (counts.y == shadingAo && gl_FrontFacing && dot(vBentNormal, vBentNormal) > 1e-12) {
    around = normalize(vBentNormal);
  }
  return m.albedo * vAccessibility * ambientAround(around);
}

void main() {
  FragmentMaterial m = readMaterial(vTexCoords, vEmissiveTexCoord, vColor);
  if (m.alpha < surfaceFactors.w) discard;
  float alpha = alphaBlend != 0 ? clamp(m.alpha, 0.0, 1.0) : 1.0;
  if (unlit != 0) {
    outRadiance = vec4(m.base * alpha, 1.0);
    outTransmitted = vec4(vec3(1.0 - alpha), 1.0);
    return;
  }
  vec3 n = shadingNormal();
  vec3 toEye = eye.w > 0.5 ? normalize(eye.xyz - vPosition) : -forward.xyz;
  float nv = max(dot(n, toEye), 0.0);
  // Exit radiance in SH shading is the albedo times the transferred light and nothing else where a surface is diffuse.
  float glossy = max(m.metallic, m.transmission);
  float specularWeight = counts.y == shadingSh ? glossy : 1.0;

  vec3 radiance = m.emission + shadeAmbient(m, n) + shadeLights(m, n, toEye, specularWeight);
  vec3 reflectance = skyReflectance(m.f0, m.roughness, nv) * glossy;
  radiance += reflectance * vAccessibility * skyRadiance(reflect(-toEye, n), levelOfRoughness(m.roughness));

  vec3 through = m.transmission * m.base * (vec3(1.0) - clamp(reflectance, 0.0, 1.0));
  outRadiance = vec4(radiance * alpha, 1.0);
  outTransmitted = vec4(vec3(1.0 - alpha) + alpha * through, 1.0);
}
