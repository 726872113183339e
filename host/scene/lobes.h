#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns true when light passes through a material by refraction.
inline bool isGlass(const CompiledMaterial& m) {
  return !m.unlit && m.transmission > 0.0f && (m.metallic < 1.0f || m.surfaceTexture.image >= 0);
}

/// Returns true when a material has a lobe around the mirrored direction, sharp or wide.
inline bool reflectsSpecularly(const CompiledMaterial& m) {
  const bool dielectric = m.transmission < 1.0f || m.transmissionTexture.image >= 0;
  return !m.unlit && (m.metallic > 0.0f || (m.specular > 0.0f && dielectric));
}

/// Roughness below which a lobe is a mirror: PRELIGHT_SMOOTH_BELOW in kernels/transport/lobe_funcs.cl.
constexpr float smoothBelow = 0.05f;

/// Returns true when a material reflects like a mirror somewhere; with a roughness texture it may do so.
inline bool mayMirror(const CompiledMaterial& m) {
  return reflectsSpecularly(m) && (m.roughness < smoothBelow || m.surfaceTexture.image >= 0);
}

/// Returns true when a measured material reflects in other ways than diffusely.
inline bool hasMeasuredLobe(const CompiledMaterial& m) {
  return m.measured != nullptr && !m.measured->rest.empty();
}

inline bool hasSheen(const CompiledMaterial& m) { return m.sheen.color != glm::vec3(0.0f); }

/// Returns true when sheen or a clear coat lies over a material.
inline bool hasLayers(const CompiledMaterial& m) { return hasSheen(m) || m.clearcoat.factor > 0.0f; }

/// Returns true when a thin film colours a material's reflection.
inline bool hasFilm(const CompiledMaterial& m) {
  return m.iridescence.factor > 0.0f && m.iridescence.thicknessMaximum > 0.0f &&
         (reflectsSpecularly(m) || isGlass(m));
}

/// Returns true when a material has a rough lobe somewhere, or a layer or film, which use the same tables.
inline bool mayReflectRoughly(const CompiledMaterial& m) {
  const bool rough = m.roughness >= smoothBelow || m.anisotropy.strength > 0.0f;
  return hasLayers(m) || hasFilm(m) || ((reflectsSpecularly(m) || isGlass(m)) && rough);
}

/// Returns true when a material's rough lobe has two widths.
inline bool isAnisotropic(const CompiledMaterial& m) {
  return m.anisotropy.strength > 0.0f && reflectsSpecularly(m);
}

/// Returns true when light passes through a material by refraction at microfacets.
inline bool isRoughGlass(const CompiledMaterial& m) {
  return isGlass(m) && (m.roughness >= smoothBelow || m.anisotropy.strength > 0.0f);
}

/// Returns true when light goes straight through a material somewhere, because it is thin, smooth glass. Such
/// light counts as direct light (kernels/transport/straight_funcs.cl).
inline bool isPane(const CompiledMaterial& m) {
  return isGlass(m) && !m.solid && m.ior != 0.0f &&
         (m.roughness < smoothBelow || m.surfaceTexture.image >= 0);
}

/// Returns true when shadow rays pass a material with a share of the light, neither all nor none.
inline bool dimsShadows(const CompiledMaterial& m) { return m.blended || isPane(m); }

/// Returns true when one of a scene's triangles has a material for which `is` is true.
template <typename Is>
bool anyTriangle(const CompiledScene& scene, Is is) {
  std::vector<bool> found;
  for (const CompiledMaterial& m : scene.materials) found.push_back(is(m));
  return std::any_of(scene.triangleMaterials.begin(), scene.triangleMaterials.end(),
                     [&](std::uint32_t material) { return found[material]; });
}

/// Returns true when the reflectance of glass differs from that of its index of refraction.
inline bool isSpecularGlass(const CompiledMaterial& m) {
  const bool plain = m.specular == 1.0f && m.specularColor == glm::vec3(1.0f);
  return isGlass(m) && (!plain || m.specularTexture.image >= 0 || m.specularColorTexture.image >= 0);
}

/// Roughness up to which a lobe counts as narrow: the root of PRELIGHT_NARROW_ALPHA in
/// kernels/transport/lobe_funcs.cl.
constexpr float narrowRoughness = 0.25f;

/// Returns true when a material sends light on in about one direction: glass, a mirror, or a narrow lobe,
/// also one that a roughness texture may make narrow. Solid glass counts whatever its roughness, as in
/// narrowLobes() of kernels/transport/lobe_funcs.cl.
inline bool makesCaustics(const CompiledMaterial& m) {
  // The greater width counts, unless a texture may reduce it.
  const float alpha = m.roughness * m.roughness, stretch = m.anisotropy.strength * m.anisotropy.strength;
  const bool even = alpha + (1.0f - alpha) * stretch <= narrowRoughness * narrowRoughness;
  const bool narrow = (m.anisotropy.strength > 0.0f ? even || m.anisotropy.texture.image >= 0
                                                    : m.roughness <= narrowRoughness) ||
                      m.surfaceTexture.image >= 0;
  const bool narrowCoat = m.clearcoat.factor > 0.0f && m.clearcoat.roughness <= narrowRoughness;
  return narrowCoat || (m.solid && isGlass(m)) || (narrow && (isGlass(m) || reflectsSpecularly(m)));
}

/// Returns true when a material sends light on in single directions somewhere: mirrors, smooth glass, smooth
/// coats. No path meets a punctual light behind them.
inline bool scattersSharply(const CompiledMaterial& m) {
  const bool smoothGlass = isGlass(m) && (m.roughness < smoothBelow || m.surfaceTexture.image >= 0);
  const bool smoothCoat = m.clearcoat.factor > 0.0f &&
                          (m.clearcoat.roughness < smoothBelow || m.clearcoat.roughnessTexture.image >= 0);
  return mayMirror(m) || smoothGlass || smoothCoat;
}

/// Returns true when transfer follows specular light from a material: those that make caustics, and glass,
/// metal and measured lobes of any roughness, because they scatter little diffusely.
inline bool carriesSpecularly(const CompiledMaterial& m) {
  return makesCaustics(m) || isGlass(m) || hasMeasuredLobe(m) || (!m.unlit && m.metallic > 0.0f);
}

/// Returns true when transfer follows only the rough lobes of a material, which are weak compared with its
/// diffuse part.
inline bool carriesGloss(const CompiledMaterial& m) {
  return !carriesSpecularly(m) && (reflectsSpecularly(m) || hasLayers(m));
}

/// Returns true when light passes through a material diffusely.
inline bool isTranslucent(const CompiledMaterial& m) { return m.diffuseTransmission != glm::vec3(0.0f); }

/// Returns true when a material's inside scatters light.
inline bool scattersWithin(const CompiledMaterial& m) {
  return m.solid && m.scattering != glm::vec3(0.0f) && (isTranslucent(m) || isGlass(m));
}

/// Returns true when diffuse light within a body is absorbed or scattered.
inline bool hasInside(const CompiledMaterial& m) {
  return scattersWithin(m) || (m.solid && m.absorption != glm::vec3(0.0f) && isTranslucent(m));
}

/// Returns true when hasInside() holds for one of a scene's materials.
inline bool anyHasInside(const CompiledScene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), hasInside);
}

/// Returns [triangle] 1 where light passes through diffusely.
inline std::vector<std::uint8_t> translucentTriangles(const CompiledScene& scene) {
  std::vector<std::uint8_t> translucent;
  for (const std::uint32_t material : scene.triangleMaterials)
    translucent.push_back(isTranslucent(scene.materials[material]) ? 1 : 0);
  return translucent;
}

}  // namespace prelight
