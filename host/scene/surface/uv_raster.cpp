#include "scene/surface/uv_raster.h"

#include <algorithm>
#include <cmath>

#include "scene/surface/triangles.h"

namespace prelight {

namespace {

/// Share of a triangle's height: nearer to an edge, two neighbours may both contain a point.
constexpr double edgeWidth = 1e-4;

/// Returns the range of grid lines that may contain points within [low, high].
std::pair<int, int> linesWithin(double low, double high, int count) {
  const double limit = count;
  return {static_cast<int>(std::clamp(std::floor(low * count) - 1.0, 0.0, limit)),
          static_cast<int>(std::clamp(std::ceil(high * count) + 1.0, 0.0, limit))};
}

}  // namespace

std::array<double, 3> uvWeights(std::span<const glm::vec2> coords, const glm::uvec3& triangle,
                                const glm::dvec2& point) {
  const glm::dvec2 a(coords[triangle.x]), b(coords[triangle.y]), c(coords[triangle.z]);
  const double area = cross(b - a, c - a);
  if (!(std::abs(area) > 0.0)) return {};
  const double second = cross(point - a, c - a) / area, third = cross(b - a, point - a) / area;
  return {1.0 - second - third, second, third};
}

UvRaster rasterizeUv(std::span<const glm::vec2> coords, std::span<const glm::uvec3> triangles, int columns,
                     int rows, const std::function<glm::dvec2(int, int)>& offset) {
  const auto points = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  UvRaster raster{columns, rows, std::vector<std::uint32_t>(points, UvRaster::nothing), 0, 0};
  std::vector<std::uint8_t> inside(points, 0);  // 1: inside a triangle, 2: counted as overlapping
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const glm::vec2 a = coords[triangles[t].x], b = coords[triangles[t].y], c = coords[triangles[t].z];
    const glm::vec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    const auto [firstColumn, lastColumn] = linesWithin(low.x, high.x, columns);
    const auto [firstRow, lastRow] = linesWithin(low.y, high.y, rows);
    for (int row = firstRow; row < lastRow; ++row)
      for (int column = firstColumn; column < lastColumn; ++column) {
        const glm::dvec2 point = (glm::dvec2(column, row) + offset(column, row)) / glm::dvec2(columns, rows);
        const auto weights = uvWeights(coords, triangles[t], point);
        const double least = std::min({weights[0], weights[1], weights[2]});
        if (least < 0.0 || weights == std::array<double, 3>{}) continue;
        const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                               static_cast<std::size_t>(column);
        if (raster.triangles[at] == UvRaster::nothing) {
          raster.triangles[at] = t;
          ++raster.covered;
        }
        if (least < edgeWidth) continue;
        if (inside[at] == 1) ++raster.overlapping;
        inside[at] = static_cast<std::uint8_t>(std::min(2, inside[at] + 1));
      }
  }
  return raster;
}

}  // namespace prelight
