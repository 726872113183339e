#include "charts/even_places.h"

#include <algorithm>
#include <cmath>

#include "charts/light_map_lookup.h"
#include "receivers/sampling.h"
#include "receivers/surface_sampler.h"

namespace prelight {

namespace {

constexpr std::uint32_t firstNumber = std::uint32_t{1} << 30;  // more than any map's number of texels

}  // namespace

std::vector<LightMapTexel> evenPlaces(const CompiledScene& scene, const LightMapLayout& layout,
                                      std::size_t count) {
  const auto areaOf = [&](std::uint32_t face) {
    if (layout.chartOf[face] == LightMapLayout::noChart) return 0.0;
    return 0.5 * glm::length(geometricNormal(scene, face % scene.triangleCount()));
  };
  const auto faces = static_cast<std::uint32_t>(layout.chartOf.size());
  double all = 0.0, sum = 0.0;
  for (std::uint32_t face = 0; face < faces; ++face) all += areaOf(face);
  std::vector<LightMapTexel> places;
  for (std::uint32_t face = 0; face < faces; ++face) {
    sum += areaOf(face);
    while ((static_cast<double>(places.size()) + 0.5) * all < sum * static_cast<double>(count)) {
      const auto number = static_cast<std::uint32_t>(places.size());
      const glm::dvec2 b = keptOffEdges(scene, face % scene.triangleCount(),
                                        sampling::uniformTriangle(sampling::sobol(number, 0x0ccu)));
      places.push_back({firstNumber + number, face, static_cast<float>(b.x), static_cast<float>(b.y), false});
    }
  }
  return places;
}

ShownError errorOfShown(const LightMap& map, std::span<const LightMapTexel> places, const FoundTwice& found) {
  double squares = 0.0, sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (found.hidden[i] != 0) continue;
    const glm::dvec3 shown =
        lightMapIrradiance(map, places[i].face, double(places[i].b1), double(places[i].b2));
    for (int c = 0; c < 3; ++c) {
      const std::size_t at = 3 * i + static_cast<std::size_t>(c);
      const double one = found.values[0][at], two = found.values[1][at];
      squares += (shown[c] - one) * (shown[c] - two);
      sum += 0.5 * (one + two);
      count += 1.0;
    }
  }
  if (!(count > 0.0)) return {};
  return {std::sqrt(std::max(0.0, squares / count)), sum / count};
}

}  // namespace prelight
