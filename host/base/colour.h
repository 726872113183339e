#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace prelight {

/// Returns the luminance of linear sRGB (weights of Rec. ITU-R BT.709).
inline double luminance(const glm::dvec3& color) {
  return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

/// Conversions of IEC 61966-2-1 between encoded and linear values in [0,1].
inline double linearOfSrgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

inline double srgbOfLinear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

/// Converts CIE XYZ to linear sRGB (IEC 61966-2-1:1999). Colours outside the gamut are clipped.
inline glm::dvec3 linearSrgb(const glm::dvec3& xyz) {
  return glm::max(glm::dvec3(3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z,
                             -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
                             0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z),
                  0.0);
}

}  // namespace prelight
