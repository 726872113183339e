#include "viewer/surface_uniforms.h"

#include "viewer/drawn_transfer.h"

namespace prelight::viewer {

void cullBacksOf(const Surface& surface) {
  if (surface.material.doubleSided) {
    glDisable(GL_CULL_FACE);
  } else {
    glEnable(GL_CULL_FACE);
  }
}

void setSurface(const Surface& surface, Features features, const gl::Texture& white, const gl::Program& p) {
  const Material& m = surface.material;
  const auto bindOrWhite = [&](Feature feature, GLuint unit, TextureHandle texture) {
    if (features.has(feature)) gl::bind(unit, GL_TEXTURE_2D, texture != nullptr ? *texture : white);
  };
  bindOrWhite(Feature::BaseColorTexture, baseColorUnit, surface.baseColor);
  bindOrWhite(Feature::MetallicRoughnessTexture, metallicRoughnessUnit, surface.metallicRoughness);
  bindOrWhite(Feature::EmissiveTexture, emissiveUnit, surface.emissive);
  bindOrWhite(Feature::NormalTexture, normalTextureUnit, surface.normal);
  p.set("normalScale", surface.normal != nullptr ? m.normalScale : 0.0f);
  // Fresnel at normal incidence; KHR_materials_ior: 0 means infinite.
  const float ratio = m.ior > 0.0f ? (m.ior - 1.0f) / (m.ior + 1.0f) : 1.0f;
  const float cutoff = m.alphaMode == AlphaMode::Mask ? m.alphaCutoff : -1.0f;
  p.set("baseColorFactor", m.baseColor);
  p.set("surfaceFactors", glm::vec4(m.metallic, m.roughness, m.transmission, cutoff));
  p.set("emissionFactor", m.emission);
  p.set("dielectricF0", glm::min(ratio * ratio * m.specularColor, glm::vec3(1.0f)));
  p.set("dielectricWeight", m.specular);
  p.set("alphaBlend", m.alphaMode == AlphaMode::Blend ? 1 : 0);
  p.set("unlit", m.unlit ? 1 : 0);
  p.set("glassIor", m.ior);
  p.set("solidGlass", m.thickness > 0.0f ? 1 : 0);
  p.set("absorption", surface.absorption);
  p.set("translucency", surface.translucency);
  p.set("showsSurroundings", surface.showsSurroundings ? 1 : 0);
  cullBacksOf(surface);
}

void setAttributeDefaults() {
  for (const Attribute attribute :
       {Attribute::Accessibility, Attribute::BentNormal, Attribute::Radiance, Attribute::Glow,
        Attribute::ChartCoord, Attribute::Reflected, Attribute::Highlight})
    glDisableVertexAttribArray(static_cast<GLuint>(attribute));
  glVertexAttrib4f(static_cast<GLuint>(Attribute::Color), 1.0f, 1.0f, 1.0f, 1.0f);
  glVertexAttrib1f(static_cast<GLuint>(Attribute::Accessibility), 1.0f);
  glVertexAttrib4f(static_cast<GLuint>(Attribute::BentNormal), 0.0f, 0.0f, 0.0f, 0.0f);
  glVertexAttrib3f(static_cast<GLuint>(Attribute::Radiance), 0.0f, 0.0f, 0.0f);
  glVertexAttrib3f(static_cast<GLuint>(Attribute::Glow), 1.0f, 1.0f, 1.0f);
  glVertexAttrib4f(static_cast<GLuint>(Attribute::ChartCoord), 0.0f, 0.0f, 0.0f, 0.0f);
  glVertexAttrib3f(static_cast<GLuint>(Attribute::Reflected), 0.0f, 0.0f, 0.0f);
  glVertexAttrib1f(static_cast<GLuint>(Attribute::Highlight), 1.0f);
  glVertexAttrib4f(static_cast<GLuint>(Attribute::Tangent), 0.0f, 0.0f, 0.0f, 0.0f);
}

}  // namespace prelight::viewer
