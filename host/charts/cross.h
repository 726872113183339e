#pragma once

#include <glm/glm.hpp>

namespace prelight {

/// Returns twice the signed area of the triangle that `a` and `b` span with the origin.
inline double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace prelight
