#include "photon/casters.h"

namespace prelight {

namespace {

constexpr float narrowRoughness = 0.25f;  // the root of PRELIGHT_NARROW_ALPHA

}  // namespace

bool makesCaustics(const CompiledMaterial& m) {
  if (m.unlit) return false;
  const bool reflects = m.metallic > 0.0f || (m.specular > 0.0f && m.transmission < 1.0f);
  const bool narrow = m.roughness <= narrowRoughness || m.surfaceTexture.image >= 0;
  const bool glass = m.transmission > 0.0f && m.metallic < 1.0f;
  return glass || (reflects && narrow);
}

std::vector<std::uint32_t> causticCasters(const CompiledScene& scene) {
  std::vector<std::uint32_t> casters;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (makesCaustics(scene.materials[scene.triangleMaterials[t]])) casters.push_back(t);
  return casters;
}

}  // namespace prelight
