#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace prelight {

/// Triangles laid flat, metres, the lower left corner of their rectangle at (0, 0).
struct ChartShape {
  std::vector<glm::dvec2> corners;  ///< [triangle][3]
  glm::dvec2 size{0.0};             ///< of the rectangle, width >= height
};

/// Turns corners so that the rectangle around them is the smallest, with an edge of their convex hull along
/// it, the longest one among equal ones: quads keep their straight sides along rows and columns of texels.
/// Then scales them so that their area is `area`, unless they have next to none.
ChartShape shapeOf(std::vector<glm::dvec2> corners, double area);

/// Which of a shape's triangles, taken in this order, lie free of those before: [triangle], 1 where it does.
/// Points of a grid as fine as the triangles decide.
std::vector<std::uint8_t> withoutOverlap(const ChartShape& shape, std::span<const std::uint32_t> order);

}  // namespace prelight
