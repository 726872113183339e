#include "gi/update/live_approximation.h"

#include <algorithm>

#include "base/colour.h"
#include "charts/irradiance/small_regions.h"
#include "gi/indirect_light.h"
#include "receivers/surface_sampler.h"

namespace prelight {

namespace {

using device::Photon;

DensityOptions optionsOf(int nearest) {
  DensityOptions options;
  options.nearest = nearest;
  return options;
}

double powerOf(const Photon& photon) {
  return luminance(glm::dvec3(photon.power[0], photon.power[1], photon.power[2]));
}

}  // namespace

LiveApproximation::LiveApproximation(const CompiledScene& scene, Tracer& tracer, const LightMapLayout& layout,
                                     const SurfaceRegions& regions, int nearest, const Device& device)
    : scene_(scene),
      places_(layout.texels),
      radius_(widestEstimate(scene)),
      surface_(makeDensitySurface(scene, regions)),
      patches_(scene, tracer, layout, surface_),
      estimator_(surface_, optionsOf(nearest), device),
      surfaces_(2 * (std::size_t{patches_.count()} + 1)),
      patchOf_(patches_.at(places_)),
      values_(layout.texels.size(), glm::vec3(0.0f)),
      grid_(layout.texelCount(), glm::vec3(0.0f)),
      shares_(sharesOfRegions(scene, regions.regionOf, layout)),
      map_(device.context(), layout) {
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    const std::uint32_t triangle = triangleOf(scene, places_[i]);
    surfaces_[2 * patchOf_[i] + (triangle == places_[i].face ? 0 : 1)].places.push_back(i);
  }
  for (std::uint32_t s = 0; s < 2 * patches_.count(); ++s)
    surfaces_[s].area = regions.areas[patches_.regionOfPatch(s / 2)];
  map_.set(grid_);
}

void LiveApproximation::follow(std::span<const std::uint32_t> triangles) {
  std::vector<std::uint32_t> regions;
  for (const std::uint32_t t : triangles)
    regions.push_back(surface_.places[t].region & ~PRELIGHT_PLANAR_REGION);
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  for (std::uint32_t s = 0; s < 2 * patches_.count(); ++s)  // photons there may now count for the other side
    if (std::binary_search(regions.begin(), regions.end(), patches_.regionOfPatch(s / 2)))
      surfaces_[s].remaining = surfaces_[s].places.size();
  followDensitySurface(surface_, scene_, regions);
  estimator_.follow(surface_);
  photonsAreOld_ = true;
}

void LiveApproximation::photonsChanged(const PhotonDelta& delta) {
  photonsAreOld_ = true;
  for (const auto* photons : {&delta.removed, &delta.added}) {
    const std::vector<std::uint32_t> maps = patches_.mapsOf(*photons);
    for (std::size_t i = 0; i < maps.size(); ++i) {
      Surface& surface = surfaces_[maps[i]];
      surface.power += powerOf((*photons)[i]);
      surface.remaining = surface.places.size();
    }
  }
}

/// Returns waiting surfaces in order of power over area, until they have enough texels.
std::vector<std::uint32_t> LiveApproximation::choose(std::uint32_t texels) {
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t s = 0; s < surfaces_.size(); ++s)
    if (surfaces_[s].remaining > 0) waiting.push_back(s);
  std::sort(waiting.begin(), waiting.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double left = surfaces_[a].power * surfaces_[b].area,
                 right = surfaces_[b].power * surfaces_[a].area;
    return left != right ? left > right : a < b;
  });
  if (texels == 0) return waiting;
  std::size_t sum = 0;
  const auto end = std::find_if(waiting.begin(), waiting.end(), [&](std::uint32_t s) {
    const bool enough = sum >= texels;
    sum += surfaces_[s].remaining;
    return enough;
  });
  waiting.erase(end, waiting.end());
  return waiting;
}

/// Returns the next `most` places of a surface.
std::vector<std::uint32_t> LiveApproximation::takePlaces(Surface& surface, std::size_t most) {
  const std::size_t count = std::min(surface.remaining, most);
  std::vector<std::uint32_t> taken;
  for (std::size_t i = 0; i < count; ++i) {
    taken.push_back(surface.places[surface.next]);
    surface.next = (surface.next + 1) % surface.places.size();
  }
  surface.remaining -= count;
  if (surface.remaining == 0) surface.power = 0.0;
  return taken;
}

/// Gives the photons of all waiting surfaces to the estimator. It keeps them until photons change.
void LiveApproximation::sortPhotons(std::span<const Photon> photons) {
  const std::vector<std::uint32_t> maps = patches_.mapsOf(photons);
  std::vector<Photon> landed;
  std::vector<std::uint32_t> landedMaps;
  for (std::size_t i = 0; i < photons.size(); ++i)
    if (surfaces_[maps[i]].remaining > 0) {
      landed.push_back(photons[i]);
      landedMaps.push_back(maps[i]);
    }
  estimator_.setPhotons(makePhotonMaps(landed, landedMaps, surfaces_.size() / 2));
  photonsAreOld_ = false;
}

ApproximationFrame LiveApproximation::advance(std::span<const Photon> photons, std::uint32_t texels) {
  ApproximationFrame frame;
  const std::vector<std::uint32_t> chosen = choose(texels);
  if (chosen.empty()) return frame;
  if (photonsAreOld_) sortPhotons(photons);
  std::vector<std::uint32_t> places;
  std::vector<std::size_t> ends;  // [chosen surface], end among places
  for (const std::uint32_t s : chosen) {
    const std::vector<std::uint32_t> taken = takePlaces(
        surfaces_[s], texels == 0 ? places_.size() : texels - std::min<std::size_t>(texels, places.size()));
    places.insert(places.end(), taken.begin(), taken.end());
    ends.push_back(places.size());
  }
  const std::vector<double> changes = estimate(places);
  for (std::size_t c = 0, i = 0; c < chosen.size(); ++c) {
    double sum = 0.0;
    for (; i < ends[c]; ++i) sum += changes[i];
    frame.changes.push_back({patches_.regionOfPatch(chosen[c] / 2),
                             sum / static_cast<double>(surfaces_[chosen[c]].places.size())});
  }
  frame.surfaces = static_cast<std::uint32_t>(chosen.size());
  frame.texels = static_cast<std::uint32_t>(places.size());
  return frame;
}

/// Estimates the texels at places. Returns the changes of their luminance.
std::vector<double> LiveApproximation::estimate(std::span<const std::uint32_t> places) {
  std::vector<LightMapTexel> texels;
  std::vector<std::uint32_t> patches;
  for (const std::uint32_t place : places) {
    texels.push_back(places_[place]);
    patches.push_back(patchOf_[place]);
  }
  const std::vector<glm::vec3> found = estimator_.estimate(densityQueries(scene_, texels, radius_, patches));
  std::vector<double> changes;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const glm::vec3 irradiance = shares_[places[i]] * found[i];
    changes.push_back(luminance(glm::abs(glm::dvec3(irradiance) - glm::dvec3(values_[places[i]]))));
    values_[places[i]] = grid_[texels[i].texel] = irradiance;
  }
  map_.set(grid_);
  return changes;
}

double LiveApproximation::meanIrradiance() const {
  double sum = 0.0;
  for (const glm::vec3& e : values_) sum += luminance(glm::dvec3(e));
  return sum / static_cast<double>(std::max<std::size_t>(1, values_.size()));
}

bool LiveApproximation::settled() const {
  return std::none_of(surfaces_.begin(), surfaces_.end(), [](const Surface& s) { return s.remaining > 0; });
}

}  // namespace prelight
