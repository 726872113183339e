#pragma once

#include <glm/glm.hpp>

namespace prelight {

/// Converts CIE XYZ to linear sRGB (IEC 61966-2-1:1999). Colours outside the gamut are clipped.
inline glm::dvec3 linearSrgb(const glm::dvec3& xyz) {
  return glm::max(glm::dvec3(3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z,
                             -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
                             0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z),
                  0.0);
}

}  // namespace prelight
