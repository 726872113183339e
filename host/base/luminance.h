#pragma once

#include <glm/glm.hpp>

namespace prelight {

/// Returns the luminance of linear sRGB (weights of Rec. ITU-R BT.709).
inline double luminance(const glm::dvec3& color) {
  return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

}  // namespace prelight
