#pragma once

#include <cmath>

#include "viewer/programs/shader_variant.h"
#include "viewer/scene/surface.h"

namespace prelight::viewer {

/// set(name, value) of what shaders read of a surface with these features, but for its textures.
template <typename Set>
void setMaterial(const Surface& surface, Features features, const Set& set) {
  const Material& m = surface.material;
  // Fresnel at normal incidence; KHR_materials_ior: 0 means infinite.
  const float ratio = m.ior > 0.0f ? (m.ior - 1.0f) / (m.ior + 1.0f) : 1.0f;
  const float cutoff = m.alphaMode == AlphaMode::Mask ? m.alphaCutoff : -1.0f;
  set("normalScale", surface.has(TextureSlot::Normal) ? m.normalScale : 0.0f);
  set("baseColorFactor", m.baseColor);
  set("surfaceFactors", glm::vec4(m.metallic, m.roughness, m.transmission, cutoff));
  set("emissionFactor", m.emission);
  set("dielectricF0", ratio * ratio * m.specularColor);
  set("dielectricWeight", m.specular);
  set("alphaBlend", m.alphaMode == AlphaMode::Blend ? 1 : 0);
  set("unlit", m.unlit ? 1 : 0);
  set("translucency", surface.translucency);
  if (features.has(Feature::Glass)) {
    set("glassIor", m.ior);
    set("solidGlass", m.thickness > 0.0f ? 1 : 0);
    set("absorption", surface.absorption);
    set("thickness", m.thickness);
  }
  if (features.has(Feature::RoughGlass)) set("glassTable", static_cast<int>(surface.glassTable));
  if (features.has(Feature::Dispersion)) set("dispersion", m.dispersion);
  if (features.has(Feature::TopLayers)) {
    const float bumps = surface.has(TextureSlot::CoatNormal) ? m.clearcoat.normalScale : 0.0f;
    set("coatFactors", glm::vec4(m.clearcoat.factor, m.clearcoat.roughness, bumps, 0.0f));
    set("sheenFactors", glm::vec4(m.sheen.color, m.sheen.roughness));
  }
  if (features.has(Feature::Anisotropy)) {
    const float textured = surface.has(TextureSlot::Anisotropy) ? 1.0f : 0.0f;
    set("anisotropy", glm::vec4(m.anisotropy.strength, std::cos(m.anisotropy.rotation),
                                std::sin(m.anisotropy.rotation), textured));
  }
  if (features.has(Feature::Film)) {
    const Iridescence& film = m.iridescence;
    const bool textured = surface.has(TextureSlot::FilmThickness);
    set("film", glm::vec4(film.factor, film.ior, textured ? film.thicknessMinimum : film.thicknessMaximum,
                          film.thicknessMaximum));
    set("filmTable", static_cast<int>(surface.filmTable));
  }
  if (features.has(Feature::Measured)) set("measured", surface.measured);
}

}  // namespace prelight::viewer
