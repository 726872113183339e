#include "photon/caustic_casters.h"

#include "scene/lobes.h"

namespace prelight {

namespace {

constexpr float narrowRoughness = 0.25f;  // the root of PRELIGHT_NARROW_ALPHA

}  // namespace

bool makesCaustics(const CompiledMaterial& m) {
  const bool narrow = m.roughness <= narrowRoughness || m.surfaceTexture.image >= 0;
  const bool narrowCoat = m.clearcoat.factor > 0.0f && m.clearcoat.roughness <= narrowRoughness;
  return narrowCoat || (narrow && (isGlass(m) || reflectsSpecularly(m)));
}

std::vector<std::uint32_t> causticCasters(const CompiledScene& scene) {
  std::vector<std::uint32_t> casters;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (makesCaustics(scene.materials[scene.triangleMaterials[t]])) casters.push_back(t);
  return casters;
}

}  // namespace prelight
