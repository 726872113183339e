#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace prelight {

/// Cells of MeasuredBrdf, in the frame of a surface whose normal is +Z. A value belongs to the centre of its
/// cell; between centres, values are interpolated.

/// Returns the index of a cell.
std::size_t brdfCell(int half, int difference, int turn);

/// Returns the interpolated value of the cells for light from wi to wo, both unit and above the surface.
glm::dvec3 brdfAt(std::span<const glm::vec3> cells, const glm::dvec3& wo, const glm::dvec3& wi);

/// Returns the cosines with the normal of the two directions at the centre of a cell; a negative one lies
/// below the surface.
glm::dvec2 cosinesOfCell(int half, int difference, int turn);

}  // namespace prelight
