#pragma once

#include <cstdint>
#include <span>

namespace prelight {

/// Numbers of one exponent, as colours have it in RGBE: number = (mantissa - 128) / 128 x 2^(exponent - 128),
/// and 0 throughout for the exponent 0. No number is off by more than 1/256 of the power of two next above
/// the greatest. Numbers beyond 2^127 saturate, and those below 2^-135 become 0.
std::uint8_t encodeSharedExponent(std::span<const float> numbers, std::span<std::uint8_t> mantissas);

float decodeSharedExponent(std::uint8_t exponent, std::uint8_t mantissa);

}  // namespace prelight
