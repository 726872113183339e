#include "compress/small_floats.h"

#include <Imath/half.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace prelight {

std::uint16_t toHalf(float value) {
  // One NaN of each sign: Imath keeps payloads, which differ from machine to machine.
  if (std::isnan(value)) return std::signbit(value) ? 0xfe00u : 0x7e00u;
  return imath_float_to_half(value);
}

float fromHalf(std::uint16_t half) { return imath_half_to_float(half); }

namespace {

constexpr int bias = 128;

}  // namespace

std::uint8_t encodeSharedExponent(std::span<const float> numbers, std::span<std::uint8_t> mantissas) {
  assert(numbers.size() == mantissas.size());
  float greatest = 0.0f;
  for (const float number : numbers) greatest = std::max(greatest, std::abs(number));
  int exponent = 0;
  std::frexp(greatest, &exponent);
  if (greatest == 0.0f || exponent <= -bias) {
    std::fill(mantissas.begin(), mantissas.end(), static_cast<std::uint8_t>(bias));
    return 0;
  }
  exponent = std::min(exponent, 127);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double mantissa = std::round(std::ldexp(double(numbers[i]), 7 - exponent)) + bias;
    mantissas[i] = static_cast<std::uint8_t>(std::clamp(mantissa, 0.0, 255.0));
  }
  return static_cast<std::uint8_t>(exponent + bias);
}

float decodeSharedExponent(std::uint8_t exponent, std::uint8_t mantissa) {
  return exponent == 0 ? 0.0f : std::ldexp(float(int(mantissa) - bias), int(exponent) - bias - 7);
}

}  // namespace prelight
