#include "compress/half_float.h"

#include <bit>

namespace prelight {

namespace {

/// `value` shifted right by `shift` >= 1 bits, rounded to nearest, ties to even.
std::uint32_t shiftRounded(std::uint32_t value, unsigned shift) {
  const std::uint32_t kept = value >> shift;
  const std::uint32_t rest = value & ((1u << shift) - 1), half = 1u << (shift - 1);
  return kept + (rest > half || (rest == half && (kept & 1u) != 0) ? 1u : 0u);
}

}  // namespace

std::uint16_t toHalf(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = (bits >> 16) & 0x8000u;
  const std::uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u) return static_cast<std::uint16_t>(sign | 0x7e00u);
  const std::uint32_t exponent = magnitude >> 23;  // biased by 127; a half's by 15
  if (exponent >= 143) return static_cast<std::uint16_t>(sign | 0x7c00u);
  if (exponent >= 113)  // a carry out of the mantissa raises the exponent, up to infinity, as it should
    return static_cast<std::uint16_t>(sign | shiftRounded(magnitude - (112u << 23), 13));
  if (exponent < 102) return static_cast<std::uint16_t>(sign);  // below half of the least denormal
  const std::uint32_t mantissa = (magnitude & 0x7fffffu) | 0x800000u;
  return static_cast<std::uint16_t>(sign | shiftRounded(mantissa, 126 - exponent));
}

float fromHalf(std::uint16_t half) {
  const std::uint32_t sign = (half & 0x8000u) << 16;
  const std::uint32_t exponent = (half >> 10) & 0x1fu, mantissa = half & 0x3ffu;
  if (exponent == 31) return std::bit_cast<float>(sign | 0x7f800000u | (mantissa << 13));
  if (exponent > 0) return std::bit_cast<float>(sign | ((exponent + 112) << 23) | (mantissa << 13));
  const float denormal = static_cast<float>(mantissa) * 0x1p-24f;
  return sign != 0 ? -denormal : denormal;
}

}  // namespace prelight
