#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "charts/light_map_charts.h"
#include "charts/mask_packing.h"
#include "prelight/light_map.h"

namespace prelight {

/// A single chart at its size in texels.
struct ChartTexels {
  struct Place {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t triangle = 0;  ///< index in LightMapChart::triangles
    glm::dvec2 weights{0.0};     ///< barycentric weights of vertices 1 and 2
  };
  std::vector<glm::vec2> corners;  ///< [triangle][3], texels from the upper left of the mask
  std::vector<Place> places;       ///< texels that a bilinear look-up can meet, row by row
  ChartMask mask;                  ///< marks these texels
};

ChartTexels makeChartTexels(const LightMapChart& chart, double texelSize);

/// Returns the texels of a chart whose corners already lie in a rectangle of texels.
ChartTexels findChartTexels(std::vector<glm::vec2> corners, int width, int height);

/// Returns a chart's texel on the map: `face` is that of the place's triangle, and the place is kept off the
/// edges as all receivers are. `origin`: of the chart's mask, texels; `width`: of the map.
LightMapTexel texelOnMap(const CompiledScene& scene, const ChartTexels::Place& place, std::uint32_t face,
                         const glm::ivec2& origin, int width);

}  // namespace prelight
