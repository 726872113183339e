#include "photon/caustic_casters.h"

namespace prelight {

std::vector<std::uint32_t> causticCasters(const CompiledScene& scene) {
  std::vector<std::uint32_t> casters;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (makesCaustics(scene.materials[scene.triangleMaterials[t]])) casters.push_back(t);
  return casters;
}

}  // namespace prelight
