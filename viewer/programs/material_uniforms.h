#pragma once

#include "viewer/scene/surface.h"

namespace prelight::viewer {

/// set(name, value) of what shaders/material.glsl and shaders/normal_map.glsl read of a surface, but for its
/// textures.
template <typename Set>
void setMaterial(const Surface& surface, const Set& set) {
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
}

}  // namespace prelight::viewer
