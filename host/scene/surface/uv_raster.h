#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight {

/// The triangle under each point of a grid over the unit square of texture coordinates.
struct UvRaster {
  static constexpr std::uint32_t nothing = 0xffffffffu;

  int columns = 0;
  int rows = 0;
  std::vector<std::uint32_t> triangles;  ///< [row][column], the first that covers the point, or `nothing`
  std::size_t covered = 0;               ///< points
  std::size_t overlapping = 0;           ///< points inside more than one triangle
};

/// Rasterises triangles in texture space. Point (column, row) of the grid lies at ((column, row) +
/// offset(column, row)) / (columns, rows), with an offset in [0, 1)^2. `coords` are the vertices' texture
/// coordinates; parts outside the square are left out.
UvRaster rasterizeUv(std::span<const glm::vec2> coords, std::span<const glm::uvec3> triangles, int columns,
                     int rows, const std::function<glm::dvec2(int, int)>& offset);

/// Returns the barycentric weights of a point relative to a triangle; zeros for one without area.
std::array<double, 3> uvWeights(std::span<const glm::vec2> coords, const glm::uvec3& triangle,
                                const glm::dvec2& point);

}  // namespace prelight
