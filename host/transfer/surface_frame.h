#pragma once

#include <glm/glm.hpp>

namespace prelight {

/// The frame of a place with a unit normal, in which light is encoded there and decoded by whoever reads it:
/// columns tangent, bitangent, normal, orthonormal. The tangent is the part of the unit direction
/// (0.36, 0.48, 0.8) that is perpendicular to the normal: it needs no texture coordinates and changes evenly
/// with the normal, so that values between places may be interpolated, but where the normal is near that
/// direction or its opposite, about which it turns once.
glm::mat3 surfaceFrame(const glm::vec3& normal);

}  // namespace prelight
