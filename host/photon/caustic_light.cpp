#include "photon/caustic_light.h"

namespace prelight {

namespace {

/// Surfaces that photons meet before they may end by chance: few lose much in mirrors and glass, and photons
/// of one power tell more than some of none.
constexpr int rouletteDepth = 8;

}  // namespace

PhotonRequest causticRequest(std::uint64_t photons, std::uint64_t seed) {
  return {.kind = PhotonKind::Caustic, .photons = photons, .seed = seed, .rouletteDepth = rouletteDepth};
}

std::unique_ptr<CausticLight> makeCausticLight(const std::vector<device::Photon>& photons,
                                               const DensitySurface& surface, double footprint,
                                               const Device& device) {
  if (photons.empty()) return nullptr;
  const PhotonMaps maps = makePhotonMaps(photons, surface);
  const CausticFilter filter = chooseCausticFilter(maps, footprint);
  auto light =
      std::make_unique<CausticLight>(CausticLight{filter, DensityEstimator(surface, filter.density, device)});
  light->estimator.setPhotons(maps);
  return light;
}

std::unique_ptr<CausticLight> traceCausticLight(const CompiledScene& compiled, TransportScene& scene,
                                                const DensitySurface& surface, std::uint64_t photons,
                                                std::uint64_t seed, double footprint, const Device& device,
                                                Progress& progress, PhotonReport& report) {
  PhotonHits hits;
  report = PhotonTracer(compiled, scene).trace(causticRequest(photons, seed), hits, progress);
  return makeCausticLight(hits.photons, surface, footprint, device);
}

}  // namespace prelight
