#include "photon/caustic_casters.h"

#include "scene/lobes.h"

namespace prelight {

namespace {

constexpr float narrowRoughness = 0.25f;  // the root of PRELIGHT_NARROW_ALPHA

}  // namespace

bool makesCaustics(const CompiledMaterial& m) {
  // The wider way counts, and a texture may make it narrow.
  const float alpha = m.roughness * m.roughness, stretch = m.anisotropy.strength * m.anisotropy.strength;
  const bool even = alpha + (1.0f - alpha) * stretch <= narrowRoughness * narrowRoughness;
  const bool narrow = (m.anisotropy.strength > 0.0f ? even || m.anisotropy.texture.image >= 0
                                                    : m.roughness <= narrowRoughness) ||
                      m.surfaceTexture.image >= 0;
  const bool narrowCoat = m.clearcoat.factor > 0.0f && m.clearcoat.roughness <= narrowRoughness;
  return narrowCoat || (m.solid && isGlass(m)) || (narrow && (isGlass(m) || reflectsSpecularly(m)));
}

std::vector<std::uint32_t> causticCasters(const CompiledScene& scene) {
  std::vector<std::uint32_t> casters;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (makesCaustics(scene.materials[scene.triangleMaterials[t]])) casters.push_back(t);
  return casters;
}

}  // namespace prelight
