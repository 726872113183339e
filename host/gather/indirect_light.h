#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "gather/final_gather.h"
#include "gather/irradiance_map.h"
#include "lightmap/light_map_layout.h"
#include "photon/density_surface.h"
#include "photon/photon_tracer.h"
#include "shade/transport_scene.h"

namespace prelight {

struct IndirectRequest {
  std::uint64_t photons = 50000;  ///< that leave lights, for the approximation that is gathered from
  int nearestPhotons = 60;        ///< of an estimate
  std::uint32_t rays = 128;       ///< a place, a power of two from 8 on
  std::uint64_t seed = 0;
};

/// Irradiance that photons tell by themselves, W/m2, at places of the surface: of all light, noisy (Larsen
/// 2004, ch. 10).
std::vector<glm::vec3> approximateIrradiance(const CompiledScene& compiled,
                                             std::span<const LightMapTexel> places,
                                             const DensitySurface& surface, const PhotonHits& hits,
                                             int nearestPhotons, const Device& device);

/// Indirect light at places of the surface: everything but direct light and caustics. A final gathering from
/// what photons left in the texels of a light map (Larsen 2004, ch. 11, over the whole hemisphere).
class IndirectLight {
 public:
  /// Sends the photons. Scene and device outlive it.
  IndirectLight(const CompiledScene& compiled, TransportScene& scene, const LightMapLayout& layout,
                const DensitySurface& surface, const IndirectRequest& request, const Device& device,
                Progress& progress);

  /// Irradiance, W/m2, [place].
  std::vector<glm::vec3> gather(std::span<const LightMapTexel> places, Progress& progress);

  const PhotonReport& photons() const { return photons_; }
  std::uint64_t rays() const { return photons_.rays + gather_.rays(); }

 private:
  const CompiledScene& compiled_;
  IndirectRequest request_;
  PhotonReport photons_;
  IrradianceMap approximation_;
  FinalGather gather_;
};

/// Queries of a density estimate at places of the surface, with a largest radius in metres.
std::vector<device::DensityQuery> densityQueries(const CompiledScene& compiled,
                                                 std::span<const LightMapTexel> places, double radius);

/// Values of a layout's texels on its grid, [y][x]; 0 where there is none.
std::vector<glm::vec3> onGrid(const LightMapLayout& layout, std::span<const glm::vec3> values);

}  // namespace prelight
