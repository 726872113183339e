#include "photon/caustic_casters.h"

namespace prelight {

namespace {

std::vector<std::uint32_t> trianglesOf(const CompiledScene& scene, bool (*casts)(const CompiledMaterial&)) {
  std::vector<std::uint32_t> casters;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (casts(scene.materials[scene.triangleMaterials[t]])) casters.push_back(t);
  return casters;
}

}  // namespace

std::vector<std::uint32_t> causticCasters(const CompiledScene& scene) {
  return trianglesOf(scene, makesCaustics);
}

std::vector<std::uint32_t> sharpCasters(const CompiledScene& scene) {
  return trianglesOf(scene, scattersSharply);
}

}  // namespace prelight
