#pragma once

#include <cstdint>
#include <span>

namespace prelight {

/// Greatest finite IEEE 754 half.
constexpr float halfMax = 65504.0f;

/// Nearest half of a float, ties to even; denormals are kept, what exceeds the range becomes infinite, a NaN
/// stays a NaN. (OpenCL's vstore_half_rte and GLSL's packHalf2x16 where it rounds to nearest.)
std::uint16_t toHalf(float value);

/// Exact.
float fromHalf(std::uint16_t half);

/// Encodes numbers with one exponent, as RGBE does for colours: number = (mantissa - 128) / 128 x 2^(exponent
/// - 128), and all are 0 for the exponent 0. The error is at most 1/256 of the power of two above the
/// greatest number. Numbers beyond 2^127 saturate, and those below 2^-135 become 0.
std::uint8_t encodeSharedExponent(std::span<const float> numbers, std::span<std::uint8_t> mantissas);

/// Returns the number of a mantissa.
float decodeSharedExponent(std::uint8_t exponent, std::uint8_t mantissa);

}  // namespace prelight
