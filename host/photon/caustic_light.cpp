#include "photon/caustic_light.h"

namespace prelight {

namespace {

/// Surfaces that photons meet before Russian roulette begins: mirrors and glass absorb little, and many
/// photons of reduced power represent caustics better than fewer of full power.
constexpr int rouletteDepth = 8;

}  // namespace

PhotonRequest causticRequest(std::uint64_t photons, std::uint64_t seed) {
  return {.kind = PhotonKind::Caustic, .photons = photons, .seed = seed, .rouletteDepth = rouletteDepth};
}

CausticMap makeCausticMap(PhotonMaps photons, double footprint) {
  if (photons.photonCount == 0) return {};
  CausticMap map;
  map.photons = std::move(photons);
  map.filter = chooseCausticFilter(map.photons, footprint);
  return map;
}

CausticMap makeCausticMap(std::span<const device::Photon> photons, const DensitySurface& surface,
                          double footprint) {
  if (photons.empty()) return {};
  return makeCausticMap(makePhotonMaps(photons, surface), footprint);
}

std::unique_ptr<CausticLight> makeCausticLight(const CausticMap& map, const DensitySurface& surface,
                                               const Device& device) {
  if (map.photons.photonCount == 0) return nullptr;
  auto light = std::make_unique<CausticLight>(
      CausticLight{map.filter, DensityEstimator(surface, map.filter.density, device)});
  light->estimator.setPhotons(map.photons);
  return light;
}

}  // namespace prelight
