#include "photon/caustic_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "photon/leaf_tree.h"

namespace prelight {

namespace {

using device::PhotonBlock;

constexpr double coveredPhotons = 0.9;
constexpr int leastNearest = 12;
constexpr int mostFiltered = 200;

/// Returns the k of least error for the caustic of a mirroring cylinder (docs/photons.md), which balances
/// bias, growing with k over the number of photons, and noise, falling with k.
int nearestFor(std::size_t photonCount) {
  const double best = 0.67 * std::pow(static_cast<double>(photonCount), 0.43);
  return std::clamp(static_cast<int>(std::lround(best)), leastNearest, mostFiltered);
}

/// Returns the area of a leaf's photons: the product of the two longest sides of its box.
double areaOf(const float* box) {
  std::array<double, 3> size{};
  for (int k = 0; k < 3; ++k) size[k] = static_cast<double>(box[3 + k]) - static_cast<double>(box[k]);
  std::sort(size.begin(), size.end());
  return size[1] * size[2];
}

struct Spread {
  double areaOfPhoton = 0.0;  ///< m2
  std::uint32_t photons = 0;
};

std::vector<Spread> spreadsOf(const PhotonMaps& maps) {
  std::vector<Spread> spreads;
  for (const device::LeafTree& tree : maps.trees) {
    const std::uint32_t leaves = tree.count == 0 ? 0 : 1u << tree.levels;
    for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
      const auto count = static_cast<std::uint32_t>(leafBegin(tree, leaf + 1) - leafBegin(tree, leaf));
      if (count < 2) continue;
      const std::size_t node = std::size_t{tree.firstNode} + leaves - 1 + leaf;
      spreads.push_back({areaOf(&maps.boxes[6 * node]) / (count - 1), count});
    }
  }
  return spreads;
}

/// Returns an area per photon that `coveredPhotons` of the photons do not exceed.
double coveringArea(std::vector<Spread> spreads) {
  std::sort(spreads.begin(), spreads.end(),
            [](const Spread& a, const Spread& b) { return a.areaOfPhoton < b.areaOfPhoton; });
  std::uint64_t all = 0, seen = 0;
  for (const Spread& spread : spreads) all += spread.photons;
  for (const Spread& spread : spreads) {
    seen += spread.photons;
    if (static_cast<double>(seen) >= coveredPhotons * static_cast<double>(all)) return spread.areaOfPhoton;
  }
  return 0.0;
}

}  // namespace

double radiusOfNearest(const PhotonMaps& photons, int k) {
  const double radius = std::sqrt(coveringArea(spreadsOf(photons)) * k / std::numbers::pi);
  return radius > 0.0 ? radius : 1e-3;  // all photons are at one place, or there are none
}

CausticFilter chooseCausticFilter(const PhotonMaps& photons, double footprint) {
  CausticFilter filter;
  filter.density.nearest = nearestFor(photons.photonCount);
  const double area = coveringArea(spreadsOf(photons)) * filter.density.nearest;
  filter.density.minRadius = 1.5 * footprint;
  filter.radius = std::max(std::sqrt(area / std::numbers::pi), filter.density.minRadius);
  if (!(filter.radius > 0.0)) filter.radius = 1e-3;  // all photons are at one place, or there are none
  return filter;
}

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
