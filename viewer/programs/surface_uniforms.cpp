#include "viewer/programs/surface_uniforms.h"

#include <array>

#include "base/text.h"
#include "viewer/programs/material_uniforms.h"
#include "viewer/programs/texture_units.h"
#include "viewer/scene/vertex_stream.h"

namespace prelight::viewer {
namespace {

/// [TextureSlot]
constexpr std::array<SlotNames, surfaceTextures> slots = {
    {{TextureSlot::BaseColor, Feature::BaseColorTexture, baseColorUnit, "baseColorU", "baseColorV"},
     {TextureSlot::MetallicRoughness, Feature::MetallicRoughnessTexture, metallicRoughnessUnit,
      "metallicRoughnessU", "metallicRoughnessV"},
     {TextureSlot::Emissive, Feature::EmissiveTexture, emissiveUnit, "emissiveU", "emissiveV"},
     {TextureSlot::Normal, Feature::NormalTexture, normalTextureUnit, "normalU", "normalV"},
     {TextureSlot::Transmission, Feature::TransmissionTexture, transmissionUnit, "transmissionU",
      "transmissionV"},
     {TextureSlot::Specular, Feature::SpecularTextures, specularUnit, "specularU", "specularV"},
     {TextureSlot::SpecularColor, Feature::SpecularTextures, specularColorUnit, "specularColorU",
      "specularColorV"},
     {TextureSlot::Coat, Feature::LayerTextures, coatUnit, "coatU", "coatV"},
     {TextureSlot::CoatRoughness, Feature::LayerTextures, coatRoughnessUnit, "coatRoughnessU",
      "coatRoughnessV"},
     {TextureSlot::CoatNormal, Feature::LayerTextures, coatNormalUnit, "coatNormalU", "coatNormalV"},
     {TextureSlot::SheenColor, Feature::LayerTextures, sheenColorUnit, "sheenColorU", "sheenColorV"},
     {TextureSlot::SheenRoughness, Feature::LayerTextures, sheenRoughnessUnit, "sheenRoughnessU",
      "sheenRoughnessV"},
     {TextureSlot::Anisotropy, Feature::Anisotropy, anisotropyUnit, "anisotropyU", "anisotropyV"},
     {TextureSlot::Film, Feature::Film, filmUnit, "filmU", "filmV"},
     {TextureSlot::FilmThickness, Feature::Film, filmThicknessUnit, "filmThicknessU", "filmThicknessV"}}};
static_assert(followsOrder(slots, &SlotNames::slot));

void setTexture(const SurfaceTexture& texture, const SlotNames& slot, const gl::Texture& white,
                const gl::Program& p) {
  gl::bind(slot.unit, GL_TEXTURE_2D, texture.texture != nullptr ? *texture.texture : white);
  p.set(slot.u, textureRow(texture.use, 0));
  p.set(slot.v, textureRow(texture.use, 1));
}

}  // namespace

const std::array<SlotNames, surfaceTextures>& slotNames() { return slots; }

glm::vec4 textureRow(const TextureRef& use, int row) {
  const glm::mat3& m = use.transform;
  return {m[0][row], m[1][row], m[2][row], static_cast<float>(use.texCoord)};
}

void cullBacksOf(const Surface& surface) {
  if (surface.material.doubleSided) {
    glDisable(GL_CULL_FACE);
  } else {
    glEnable(GL_CULL_FACE);
  }
}

void setSurface(const Surface& surface, Features features, const gl::Texture& white, const gl::Program& p) {
  for (std::size_t slot = 0; slot < surfaceTextures; ++slot)
    if (features.has(slots[slot].feature)) setTexture(surface.textures[slot], slots[slot], white, p);
  setMaterial(surface, features, [&](const char* name, const auto& value) { p.set(name, value); });
  p.set("showsSurroundings", surface.showsSurroundings ? 1 : 0);
  cullBacksOf(surface);
}

void setUnknownAccessibility() { glVertexAttrib1f(static_cast<GLuint>(Attribute::Accessibility), -1.0f); }

void setAttributeDefaults() {
  for (const Attribute attribute :
       {Attribute::Accessibility, Attribute::BentNormal, Attribute::Radiance, Attribute::Glow,
        Attribute::ChartCoord, Attribute::Reflected, Attribute::Highlight, Attribute::Openness})
    glDisableVertexAttribArray(static_cast<GLuint>(attribute));
  glVertexAttrib4f(static_cast<GLuint>(Attribute::Color), 1.0f, 1.0f, 1.0f, 1.0f);
  glVertexAttrib1f(static_cast<GLuint>(Attribute::Accessibility), 1.0f);
  glVertexAttrib4f(static_cast<GLuint>(Attribute::BentNormal), 0.0f, 0.0f, 0.0f, 0.0f);
  glVertexAttrib3f(static_cast<GLuint>(Attribute::Radiance), 0.0f, 0.0f, 0.0f);
  glVertexAttrib3f(static_cast<GLuint>(Attribute::Glow), 1.0f, 1.0f, 1.0f);
  glVertexAttrib4f(static_cast<GLuint>(Attribute::ChartCoord), 0.0f, 0.0f, 0.0f, 0.0f);
  glVertexAttrib3f(static_cast<GLuint>(Attribute::Reflected), 0.0f, 0.0f, 0.0f);
  glVertexAttrib1f(static_cast<GLuint>(Attribute::Highlight), 1.0f);
  glVertexAttrib3f(static_cast<GLuint>(Attribute::Openness), 1.0f, 1.0f, 1.0f);
  for (GLuint stream = 0; stream < lampVisibilityStreams; ++stream) {
    const GLuint attribute = static_cast<GLuint>(Attribute::LampVisibility) + stream;
    glDisableVertexAttribArray(attribute);
    glVertexAttrib4f(attribute, 1.0f, 1.0f, 1.0f, 1.0f);
  }
}

}  // namespace prelight::viewer
