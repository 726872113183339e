// Material of a fragment; needs variant.glsl. From the uniforms of Surface, its textures and vertex colours.
#include "core/dialect.h"
uniform vec4 baseColorFactor;
uniform vec4 surfaceFactors;     // metallic, roughness, transmission, alpha cutoff (< 0: none)
uniform vec4 translucency;       // of light that comes through from the other side: colour x share, share; 0: opaque
uniform vec3 emissionFactor;
uniform vec3 dielectricF0;       // reflectance at normal incidence of the non-metallic part; bounded by 1, and times its weight
uniform float dielectricWeight;  // KHR_materials_specular.specularFactor
uniform int alphaBlend;
uniform int unlit;
uniform int doubleSided;
#include "primitive.glsl"
uniform sampler2D baseColorTexture;
uniform sampler2D metallicRoughnessTexture;
uniform sampler2D emissiveTexture;
uniform sampler2D transmissionTexture;   // R
uniform sampler2D specularTexture;       // A
uniform sampler2D specularColorTexture;
// Where a texture lies, a row each of its u and v: factors of (u, v, 1), and which of the file's two sets they are of.
uniform vec4 baseColorU;
uniform vec4 baseColorV;
uniform vec4 metallicRoughnessU;
uniform vec4 metallicRoughnessV;
uniform vec4 emissiveU;
uniform vec4 emissiveV;
uniform vec4 transmissionU;
uniform vec4 transmissionV;
uniform vec4 specularU;
uniform vec4 specularV;
uniform vec4 specularColorU;
uniform vec4 specularColorV;
uniform TEXELS triangleNormals;  // see RenderScene

struct FragmentMaterial {
  vec3 base;
  float alpha;
  float metallic;
  float roughness;
  float glass;         // share of the dielectric
  float transmission;  // share of the surface
  vec3 through;  // albedo of the body for light that leaves on the other side
  vec3 dielectric;  // reflectance of the layer along the normal
  float f90;        // at grazing angles
  vec3 emission;
};

vec2 texturePlace(vec4 texCoords, vec4 u, vec4 v) {
  vec3 at = vec3(u.w > 0.5 ? texCoords.zw : texCoords.xy, 1.0);
  return vec2(dot(u.xyz, at), dot(v.xyz, at));
}

FragmentMaterial readMaterial(vec4 texCoords, vec4 vertexColor) {
  vec4 base = baseColorFactor;
  if (hasBaseColorTexture) base *= texture(baseColorTexture, texturePlace(texCoords, baseColorU, baseColorV));
  if (hasVertexColors) base *= vertexColor;
  vec4 factors = vec4(1.0);
  if (hasMetallicRoughnessTexture)
    factors = texture(metallicRoughnessTexture, texturePlace(texCoords, metallicRoughnessU, metallicRoughnessV));
  FragmentMaterial m;
  m.base = base.rgb;
  m.alpha = base.a;
  m.glass = hasGlass ? surfaceFactors.z : 0.0;
  if (hasTransmissionTexture) m.glass *= texture(transmissionTexture, texturePlace(texCoords, transmissionU, transmissionV)).r;
  vec4 passing = hasTranslucency ? translucency : vec4(0.0);
  m.metallic = hasGloss ? surfaceFactors.x * factors.b : 0.0;
  m.roughness = surfaceFactors.y * factors.g;
  m.transmission = m.glass * (1.0 - m.metallic);
  m.through = min(passing.rgb, vec3((1.0 - m.metallic) * (1.0 - m.glass) * passing.a));
  m.dielectric = dielectricF0;
  m.f90 = dielectricWeight;
  if (hasSpecularTextures) {
    m.dielectric *= texture(specularColorTexture, texturePlace(texCoords, specularColorU, specularColorV)).rgb;
    m.f90 *= texture(specularTexture, texturePlace(texCoords, specularU, specularV)).a;
  }
  m.dielectric = min(m.dielectric, vec3(1.0)) * m.f90;
  m.emission = hasEmission ? emissionFactor : vec3(0.0);
  if (hasEmissiveTexture) m.emission *= texture(emissiveTexture, texturePlace(texCoords, emissiveU, emissiveV)).rgb;
  return m;
}
