#include "techniques/chart_transfer/chart_places.h"

#include <cstdint>
#include <span>

#include "fit/texel_fill.h"
#include "scene/gltf/charts.h"
#include "scene/surface/uv_raster.h"

namespace prelight {
namespace {

constexpr std::size_t numbers = 6;  ///< of a place

void setPlace(const CompiledScene& scene, const PrimitiveRange& range, const glm::uvec3& corners,
              const glm::dvec3& weights, std::span<float> place) {
  for (int k = 0; k < 3; ++k) {
    const std::size_t vertex = range.firstVertex + corners[k];
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<std::size_t>(axis);
      place[at] += static_cast<float>(weights[k] * scene.positions[vertex][axis]);
      place[3 + at] += static_cast<float>(weights[k] * scene.normals[vertex][axis]);
    }
  }
}

}  // namespace

std::vector<ChartPlace> placesOf(const ChartTransfer::Map& map, const CompiledScene& scene) {
  const PrimitiveRange& range = scene.primitives[map.primitive];
  const std::vector<glm::uvec3> triangles = trianglesOf(scene, range);
  const auto middle = [](int, int) { return glm::dvec2(0.5); };
  const UvRaster raster = rasterizeUv(map.coords, triangles, map.width, map.height, middle);
  std::vector<float> places(map.texels() * numbers, 0.0f);
  std::vector<std::uint8_t> filled(map.texels(), 0);
  for (std::size_t texel = 0; texel < map.texels(); ++texel) {
    const std::uint32_t t = raster.triangles[texel];
    if (t == UvRaster::nothing) continue;
    const auto width = static_cast<std::size_t>(map.width);
    const glm::dvec2 point =
        (glm::dvec2(texel % width, texel / width) + 0.5) / glm::dvec2(map.width, map.height);
    const auto weights = uvWeights(map.coords, triangles[t], point);
    setPlace(scene, range, triangles[t], {weights[0], weights[1], weights[2]},
             std::span(places).subspan(texel * numbers, numbers));
    filled[texel] = 1;
  }
  fillTexels(map.width, map.height, numbers, filled, places);
  std::vector<ChartPlace> result(map.texels());
  for (std::size_t texel = 0; texel < result.size(); ++texel) {
    const float* place = &places[texel * numbers];
    const glm::vec3 normal(place[3], place[4], place[5]);
    const float length = glm::length(normal);
    result[texel] = {{place[0], place[1], place[2]}, length > 0.0f ? normal / length : glm::vec3(0.0f)};
  }
  return result;
}

}  // namespace prelight
