#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "charts/chart_packing.h"
#include "charts/light_map_charts.h"
#include "prelight/light_map.h"

namespace prelight {

/// The texels that a chart needs, within their bounding rectangle.
struct ChartMask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> cells;  ///< [y][x], 1: needed
};

/// An atlas in which masks are packed, texels.
struct MaskPacking {
  int width = 0;
  int height = 0;
  std::vector<glm::ivec2> origins;  ///< [mask] position of its upper left texel
};

/// Packs masks so that no texel is used twice: the largest first, each at the first free place, row by row,
/// at the width that leaves the least area unused. Returns nothing when that takes more than `mostSide`
/// texels per side.
std::optional<MaskPacking> packMasks(std::span<const ChartMask> masks, int mostSide);

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
