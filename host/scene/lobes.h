#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

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

/// Whether a measured material reflects otherwise than diffusely.
inline bool hasMeasuredLobe(const CompiledMaterial& m) {
  return m.measured != nullptr && !m.measured->rest.empty();
}

inline bool hasSheen(const CompiledMaterial& m) { return m.sheen.color != glm::vec3(0.0f); }

/// Whether a layer lies over the rest of a material.
inline bool hasLayers(const CompiledMaterial& m) { return hasSheen(m) || m.clearcoat.factor > 0.0f; }

/// Whether a thin film colours what it reflects.
inline bool hasFilm(const CompiledMaterial& m) {
  return m.iridescence.factor > 0.0f && m.iridescence.thicknessMaximum > 0.0f &&
         (reflectsSpecularly(m) || isGlass(m));
}

/// Whether it has a rough lobe somewhere, or a layer or film, which look lobes up like one.
inline bool mayReflectRoughly(const CompiledMaterial& m) {
  const bool rough = m.roughness >= smoothBelow || m.anisotropy.strength > 0.0f;
  return hasLayers(m) || hasFilm(m) || ((reflectsSpecularly(m) || isGlass(m)) && rough);
}

/// Whether its rough lobe is wider one way than the other.
inline bool isAnisotropic(const CompiledMaterial& m) {
  return m.anisotropy.strength > 0.0f && reflectsSpecularly(m);
}

/// Whether light passes through a material by refraction at microfacets.
inline bool isRoughGlass(const CompiledMaterial& m) {
  return isGlass(m) && (m.roughness >= smoothBelow || m.anisotropy.strength > 0.0f);
}

/// Whether light goes straight on through a material somewhere: it is thin glass, and smooth there. Such
/// light is direct light (kernels/transport/straight_funcs.cl).
inline bool isPane(const CompiledMaterial& m) {
  return isGlass(m) && !m.solid && m.ior != 0.0f &&
         (m.roughness < smoothBelow || m.surfaceTexture.image >= 0);
}

/// Whether shadow rays bring a share of the light that meets a material, neither all of it nor nothing.
inline bool dimsShadows(const CompiledMaterial& m) { return m.blended || isPane(m); }

/// Whether one of a scene's triangles has a material of which `is` is true.
template <typename Is>
bool anyTriangle(const CompiledScene& scene, Is is) {
  std::vector<bool> found;
  for (const CompiledMaterial& m : scene.materials) found.push_back(is(m));
  return std::any_of(scene.triangleMaterials.begin(), scene.triangleMaterials.end(),
                     [&](std::uint32_t material) { return found[material]; });
}

/// Whether glass reflects otherwise than its index of refraction tells.
inline bool isSpecularGlass(const CompiledMaterial& m) {
  const bool plain = m.specular == 1.0f && m.specularColor == glm::vec3(1.0f);
  return isGlass(m) && (!plain || m.specularTexture.image >= 0 || m.specularColorTexture.image >= 0);
}

/// Roughness up to which a lobe counts as narrow: the root of PRELIGHT_NARROW_ALPHA in
/// kernels/transport/lobe_funcs.cl.
constexpr float narrowRoughness = 0.25f;

/// Whether a material sends light on in about one direction: glass, a mirror, or a lobe, unless it is
/// wide. A texture of roughness may make it so. Solid glass does whatever its roughness, as narrowLobes() has
/// it in kernels/transport/lobe_funcs.cl.
inline bool makesCaustics(const CompiledMaterial& m) {
  // The wider way counts, and a texture may make it narrow.
  const float alpha = m.roughness * m.roughness, stretch = m.anisotropy.strength * m.anisotropy.strength;
  const bool even = alpha + (1.0f - alpha) * stretch <= narrowRoughness * narrowRoughness;
  const bool narrow = (m.anisotropy.strength > 0.0f ? even || m.anisotropy.texture.image >= 0
                                                    : m.roughness <= narrowRoughness) ||
                      m.surfaceTexture.image >= 0;
  const bool narrowCoat = m.clearcoat.factor > 0.0f && m.clearcoat.roughness <= narrowRoughness;
  return narrowCoat || (m.solid && isGlass(m)) || (narrow && (isGlass(m) || reflectsSpecularly(m)));
}

/// Whether a material sends light on in single directions somewhere: mirrors, smooth glass, smooth coats.
/// Behind them no path meets a punctual light.
inline bool scattersSharply(const CompiledMaterial& m) {
  const bool smoothGlass = isGlass(m) && (m.roughness < smoothBelow || m.surfaceTexture.image >= 0);
  const bool smoothCoat = m.clearcoat.factor > 0.0f &&
                          (m.clearcoat.roughness < smoothBelow || m.clearcoat.roughnessTexture.image >= 0);
  return mayMirror(m) || smoothGlass || smoothCoat;
}

/// Whether transfer goes on from a material otherwise than diffusely: what makes caustics, and glass, metal
/// and measured lobes whatever their roughness, as they send little diffusely.
inline bool carriesSpecularly(const CompiledMaterial& m) {
  return makesCaustics(m) || isGlass(m) || hasMeasuredLobe(m) || (!m.unlit && m.metallic > 0.0f);
}

/// Whether it goes on from its rough lobes alone, which are small beside what the material sends diffusely.
inline bool carriesGloss(const CompiledMaterial& m) {
  return !carriesSpecularly(m) && (reflectsSpecularly(m) || hasLayers(m));
}

/// Whether light passes through a material diffusely.
inline bool isTranslucent(const CompiledMaterial& m) { return m.diffuseTransmission != glm::vec3(0.0f); }

/// Whether a material's inside scatters light that gets there.
inline bool scattersWithin(const CompiledMaterial& m) {
  return m.solid && m.scattering != glm::vec3(0.0f) && (isTranslucent(m) || isGlass(m));
}

/// Whether light that is diffuse within a body loses some there, or is scattered.
inline bool hasInside(const CompiledMaterial& m) {
  return scattersWithin(m) || (m.solid && m.absorption != glm::vec3(0.0f) && isTranslucent(m));
}

/// Whether one of a scene's materials does so.
inline bool anyHasInside(const CompiledScene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), hasInside);
}

/// [triangle], 1 where light passes through diffusely.
inline std::vector<std::uint8_t> translucentTriangles(const CompiledScene& scene) {
  std::vector<std::uint8_t> translucent;
  for (const std::uint32_t material : scene.triangleMaterials)
    translucent.push_back(isTranslucent(scene.materials[material]) ? 1 : 0);
  return translucent;
}

}  // namespace prelight
