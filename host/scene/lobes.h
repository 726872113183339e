#pragma once

#include "prelight/compiled_scene.h"

namespace prelight {

/// Whether light passes through a material by refraction.
inline bool isGlass(const CompiledMaterial& m) {
  return !m.unlit && m.transmission > 0.0f && (m.metallic < 1.0f || m.surfaceTexture.image >= 0);
}

/// Whether a material has a lobe about the mirrored direction, sharp or wide.
inline bool reflectsSpecularly(const CompiledMaterial& m) {
  const bool dielectric = m.transmission < 1.0f || m.transmissionTexture.image >= 0;
  return !m.unlit && (m.metallic > 0.0f || (m.specular > 0.0f && dielectric));
}

/// Roughness below which a lobe is a mirror: PRELIGHT_SMOOTH_BELOW in kernels/transport/lobe_funcs.cl.
constexpr float smoothBelow = 0.05f;

/// Whether it reflects like a mirror somewhere; with a texture of roughness a surface may be either.
inline bool mayMirror(const CompiledMaterial& m) {
  return reflectsSpecularly(m) && (m.roughness < smoothBelow || m.surfaceTexture.image >= 0);
}

inline bool hasSheen(const CompiledMaterial& m) { return m.sheen.color != glm::vec3(0.0f); }

/// Whether a layer lies over the rest of a material.
inline bool hasLayers(const CompiledMaterial& m) { return hasSheen(m) || m.clearcoat.factor > 0.0f; }

/// Whether it has a rough lobe somewhere, or a layer, which looks lobes up like one.
inline bool mayReflectRoughly(const CompiledMaterial& m) {
  return hasLayers(m) || ((reflectsSpecularly(m) || isGlass(m)) && m.roughness >= smoothBelow);
}

/// Whether light passes through a material by refraction at microfacets.
inline bool isRoughGlass(const CompiledMaterial& m) { return isGlass(m) && m.roughness >= smoothBelow; }

/// Whether light passes through a material diffusely.
inline bool isTranslucent(const CompiledMaterial& m) { return m.diffuseTransmission != glm::vec3(0.0f); }

}  // namespace prelight
