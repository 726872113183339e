#pragma once

#include <glm/glm.hpp>

namespace prelight {

/// Returns the frame of a place with a unit normal, in which light is encoded and decoded: orthonormal
/// columns tangent, bitangent, normal. The tangent is the component of the unit direction (0.36, 0.48, 0.8)
/// perpendicular to the normal. It needs no texture coordinates and varies smoothly with the normal, so that
/// values may be interpolated between places, except near that direction and its opposite, around which it
/// turns once.
glm::mat3 surfaceFrame(const glm::vec3& normal);

}  // namespace prelight
