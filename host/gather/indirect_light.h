#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "gather/irradiance_map.h"
#include "lightmap/light_map_layout.h"
#include "photon/density_surface.h"
#include "photon/photon_tracer.h"
#include "shade/transport_scene.h"

namespace prelight {

struct IndirectRequest {
  std::uint64_t photons = 100000;  ///< that leave lights, for the approximation that is gathered from
  int nearestPhotons = 60;         ///< of an estimate
  std::uint32_t rays = 128;        ///< a texel, a power of two, 8 to 256
  std::uint64_t seed = 0;
};

struct IndirectReport {
  PhotonReport photons;
  std::uint64_t gatherRays = 0;
  std::vector<std::pair<std::string, double>> stageSeconds;
};

/// Irradiance of a light map's texels that photons tell by themselves, W/m2, [y][x]: of all light, noisy
/// (Larsen 2004, ch. 10).
std::vector<glm::vec3> approximateIrradiance(const CompiledScene& compiled, const LightMapLayout& layout,
                                             const DensitySurface& surface, const PhotonHits& hits,
                                             int nearestPhotons, const Device& device);

/// Indirect irradiance of a light map's texels, W/m2, [y][x]: everything but direct light and caustics. A
/// final gathering from what photons left on all surfaces (Larsen 2004, ch. 11, over the whole hemisphere).
std::vector<glm::vec3> gatherIndirectLight(const CompiledScene& compiled, TransportScene& scene,
                                           const LightMapLayout& layout, const DensitySurface& surface,
                                           const IndirectRequest& request, const Device& device,
                                           Progress& progress, IndirectReport& report);

}  // namespace prelight
