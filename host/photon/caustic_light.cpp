#include "photon/caustic_light.h"

namespace prelight {

namespace {

/// Surfaces that photons meet before they may end by chance: few lose much in mirrors and glass, and photons
/// of one power tell more than some of none.
constexpr int rouletteDepth = 8;

}  // namespace

std::unique_ptr<CausticLight> traceCausticLight(const CompiledScene& compiled, TransportScene& scene,
                                                const DensitySurface& surface, std::uint64_t photons,
                                                std::uint64_t seed, double footprint, const Device& device,
                                                Progress& progress, PhotonReport& report) {
  PhotonRequest request;
  request.kind = PhotonKind::Caustic;
  request.photons = photons;
  request.seed = seed;
  request.rouletteDepth = rouletteDepth;
  PhotonHits hits;
  report = PhotonTracer(compiled, scene).trace(request, hits, progress);
  if (hits.photons.empty()) return nullptr;
  const PhotonMaps maps = makePhotonMaps(hits.photons, surface);
  const CausticFilter filter = chooseCausticFilter(maps, footprint);
  auto light =
      std::make_unique<CausticLight>(CausticLight{filter, DensityEstimator(surface, filter.density, device)});
  light->estimator.setPhotons(maps);
  return light;
}

}  // namespace prelight
