#include "charts/irradiance/hollows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "charts/first_obstacles.h"
#include "charts/light_map_lookup.h"
#include "charts/texel_cells.h"
#include "receivers/sampling.h"
#include "receivers/surface_sampler.h"
#include "scene/surface/triangles.h"

namespace prelight {
namespace {

constexpr std::uint32_t raysPerPlace = 16;
constexpr std::uint8_t mostOpenOfHollows = 2;  // rays
constexpr std::size_t placesPerTrace = std::size_t{1} << 15;

/// Returns the side of a face's texels, m: the root of the area of one.
double texelSide(const CompiledScene& scene, const LightMapLayout& layout, std::uint32_t face) {
  const double texels = texelsOf(layout, face),
               area = 0.5 * glm::length(geometricNormal(scene, face % scene.triangleCount()));
  return texels > 0.0 ? std::sqrt(area / texels) : 0.0;
}

/// Counts the rays from places that meet nothing within a texel's side.
class OpenRays {
 public:
  OpenRays(const CompiledScene& scene, Tracer& tracer, const LightMapLayout& layout,
           std::span<const std::uint8_t> ignored)
      : scene_(scene), tracer_(tracer), layout_(layout), ignored_(ignored) {}

  /// Returns the number of such rays, [place] 0 to raysPerPlace.
  std::vector<std::uint8_t> count(std::span<const LightMapTexel> places) {
    std::vector<std::uint8_t> open;
    for (std::size_t first = 0; first < places.size(); first += placesPerTrace)
      countBlock(places.subspan(first, std::min(placesPerTrace, places.size() - first)), open);
    return open;
  }

 private:
  void countBlock(std::span<const LightMapTexel> places, std::vector<std::uint8_t>& open) {
    rays_.clear();
    for (const LightMapTexel& place : places) addRays(place);
    const std::vector<device::Hit> hits =
        ignored_.empty() ? tracer_.traceAny(rays_)
                         : firstObstacles(tracer_, rays_, [&](std::size_t, std::uint32_t triangle) {
                             return ignored_[triangle] != 0;
                           });
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto own = std::span(hits).subspan(i * raysPerPlace, raysPerPlace);
      open.push_back(static_cast<std::uint8_t>(
          std::ranges::count_if(own, [&](const device::Hit& hit) { return !isBlocked(hit); })));
    }
  }

  /// Returns whether a ray meets something that counts, by its hit.
  bool isBlocked(const device::Hit& hit) const {
    return hit.triangle != PRELIGHT_NO_TRIANGLE && (ignored_.empty() || ignored_[hit.triangle] == 0);
  }

  void addRays(const LightMapTexel& place) {
    const device::Receiver from = receiverAt(scene_, place);
    const glm::dvec3 normal(from.geometricNormal[0], from.geometricNormal[1], from.geometricNormal[2]);
    const double side = texelSide(scene_, layout_, place.face);
    const std::uint32_t seed = sampling::hashInteger(place.texel);
    for (std::uint32_t r = 0; r < raysPerPlace; ++r) {
      const glm::dvec3 way = side * sampling::cosineHemisphere(sampling::sobol(r, seed), normal);
      device::Ray& ray = rays_.emplace_back();
      for (int k = 0; k < 3; ++k) {
        ray.origin[k] = from.position[k];
        ray.direction[k] = static_cast<float>(way[k]);
      }
      ray.sourceTriangle = from.triangle;
      ray.tMax = side > 0.0 ? 1.0f : 0.0f;
    }
  }

  const CompiledScene& scene_;
  Tracer& tracer_;
  const LightMapLayout& layout_;
  std::span<const std::uint8_t> ignored_;
  std::vector<device::Ray> rays_;
};

}  // namespace

void leaveHollows(const CompiledScene& scene, Tracer& tracer, LightMapLayout& layout,
                  std::span<const std::uint8_t> ignored) {
  OpenRays rays(scene, tracer, layout, ignored);
  const std::vector<std::uint8_t> open = rays.count(layout.texels);
  std::vector<LightMapTexel> candidates;
  std::vector<std::size_t> owners, firsts;  // texels in hollows, and their first candidates
  std::optional<TexelCells> cells;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (open[i] > mostOpenOfHollows) continue;
    if (!cells) cells.emplace(scene, layout);
    owners.push_back(i);
    firsts.push_back(candidates.size());
    std::ranges::copy(cells->within(layout.texels[i]), std::back_inserter(candidates));
  }
  firsts.push_back(candidates.size());
  const std::vector<std::uint8_t> found = rays.count(candidates);
  const auto isOpen = [](std::uint8_t count) { return count > mostOpenOfHollows; };
  for (std::size_t n = 0; n < owners.size(); ++n) {
    const auto own = std::span(found).subspan(firsts[n], firsts[n + 1] - firsts[n]);
    if (2 * std::ranges::count_if(own, isOpen) <= std::ssize(own)) continue;
    const auto nearest = std::ranges::find_if(own, isOpen) - own.begin();
    layout.texels[owners[n]] = candidates[firsts[n] + static_cast<std::size_t>(nearest)];
  }
}

}  // namespace prelight
