#include "gi/gi_memory.h"

#include <algorithm>

#include "base/luminance.h"

namespace prelight {

namespace {

// Photons and rays in flight, and their kernels.
constexpr std::uint64_t blockBytes = std::uint64_t{80} << 20;
constexpr double bytesPerLanding = 160.0;  // per photon: as it landed, while maps are made, and on the device
constexpr double mostLandings = 3.0;       // per photon; whiter scenes are rare

/// Returns the share of light that surfaces reflect diffusely, averaged over their area. Textures count as
/// white.
double meanAlbedo(const CompiledScene& scene) {
  double reflected = 0.0, area = 0.0;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const double size = glm::length(geometricNormal(scene, t));
    reflected += size * luminance(glm::dvec3(scene.materials[scene.triangleMaterials[t]].albedo));
    area += size;
  }
  return area > 0.0 ? reflected / area : 0.0;
}

}  // namespace

std::uint64_t indirectLightBytes(const CompiledScene& scene, std::uint64_t photons) {
  const double albedo = std::min(meanAlbedo(scene), 0.99);
  // Without the first, which is direct light.
  const double landings = std::min(mostLandings, albedo / (1.0 - albedo));
  return blockBytes + static_cast<std::uint64_t>(bytesPerLanding * landings * static_cast<double>(photons));
}

}  // namespace prelight
