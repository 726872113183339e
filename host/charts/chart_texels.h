#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "charts/light_map_charts.h"
#include "charts/mask_packing.h"
#include "prelight/light_map.h"

namespace prelight {

/// A chart at its size in texels, by itself.
struct ChartTexels {
  struct Place {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t triangle = 0;  ///< place in LightMapChart::triangles
    glm::dvec2 weights{0.0};     ///< of vertices 1 and 2
  };
  std::vector<glm::vec2> corners;  ///< [triangle][3], texels from the upper left of the mask
  std::vector<Place> places;       ///< of the texels that a bilinear look-up can meet, row by row
  ChartMask mask;                  ///< of these
};

ChartTexels makeChartTexels(const LightMapChart& chart, double texelSize);

/// Texels of a chart whose corners lie in a rectangle of texels already.
ChartTexels findChartTexels(std::vector<glm::vec2> corners, int width, int height);

/// A chart's texel on the map: `face` is that of the place's triangle, kept off its edges as all receivers.
/// `origin`: of the chart's mask, texels; `width`: of the map.
LightMapTexel texelOnMap(const CompiledScene& scene, const ChartTexels::Place& place, std::uint32_t face,
                         const glm::ivec2& origin, int width);

}  // namespace prelight
