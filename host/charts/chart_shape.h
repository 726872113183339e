#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight {

/// Flattened triangles in metres, with the lower left corner of their rectangle at (0, 0).
struct ChartShape {
  std::vector<glm::dvec2> corners;  ///< [triangle][3]
  glm::dvec2 size{0.0};             ///< size of the rectangle, width >= height
};

/// Rotates corners so that the rectangle around them is the smallest with a side along an edge of their
/// convex hull, the longest edge among equals: quads keep their straight sides along rows and columns of
/// texels. Then scales them so that their area is `area`, unless they have almost none.
ChartShape shapeOf(std::vector<glm::dvec2> corners, double area);

/// Returns [triangle] 1 where a shape's triangle, taken in this order, does not overlap those before. The
/// test uses the points of a grid as fine as the triangles.
std::vector<std::uint8_t> withoutOverlap(const ChartShape& shape, std::span<const std::uint32_t> order);

}  // namespace prelight
