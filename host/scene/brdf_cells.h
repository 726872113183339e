#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace prelight {

/// Cells of MeasuredBrdf, in the frame of a surface whose normal is +Z. A value is that of its cell's middle;
/// between middles values are interpolated.

/// The place of a cell among the cells.
std::size_t brdfCell(int half, int difference, int turn);

/// What cells hold for light from wi to wo, unit and above the surface.
glm::dvec3 brdfAt(std::span<const glm::vec3> cells, const glm::dvec3& wo, const glm::dvec3& wi);

/// Cosines of the two directions that the middle of a cell stands for with the normal; below 0 one of them
/// lies below the surface.
glm::dvec2 cosinesOfCell(int half, int difference, int turn);

}  // namespace prelight
