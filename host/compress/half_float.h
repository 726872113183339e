#pragma once

#include <cstdint>

namespace prelight {

/// Greatest finite IEEE 754 half.
constexpr float halfMax = 65504.0f;

/// Nearest half of a float, ties to even; denormals are kept, what exceeds the range becomes infinite, a NaN
/// stays a NaN. (OpenCL's vstore_half_rte and GLSL's packHalf2x16 where it rounds to nearest.)
std::uint16_t toHalf(float value);

/// Exact.
float fromHalf(std::uint16_t half);

}  // namespace prelight
