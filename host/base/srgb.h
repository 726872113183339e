#pragma once

#include <cmath>

namespace prelight {

/// Conversions of IEC 61966-2-1 between encoded and linear values in [0,1].
inline double linearOfSrgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

inline double srgbOfLinear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

}  // namespace prelight
