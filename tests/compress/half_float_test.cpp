#include "compress/small_floats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace prelight {
namespace {

constexpr std::uint16_t infinity = 0x7c00;

/// Value of a finite, positive half by the definition of the format.
double valueOf(std::uint16_t half) {
  const int exponent = half >> 10, mantissa = half & 0x3ff;
  return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
}

/// Nearest half by search; ties go to the even one.
std::uint16_t nearestHalf(double magnitude) {
  if (magnitude >= 65520.0) return infinity;  // Half a unit above the greatest.
  std::uint16_t low = 0, high = infinity - 1;
  while (high - low > 1) {
    const auto middle = static_cast<std::uint16_t>((low + high) / 2);
    (valueOf(middle) <= magnitude ? low : high) = middle;
  }
  const double below = magnitude - valueOf(low), above = valueOf(high) - magnitude;
  if (below == above) return low % 2 == 0 ? low : high;
  return below < above ? low : high;
}

TEST(HalfFloat, EveryHalf_ComesBackFromItsFloat) {
  for (std::uint32_t half = 0; half < infinity; ++half) {
    const auto bits = static_cast<std::uint16_t>(half);
    ASSERT_EQ(double(fromHalf(bits)), valueOf(bits)) << half;
    ASSERT_EQ(double(fromHalf(bits | 0x8000)), -valueOf(bits)) << half;
    ASSERT_EQ(toHalf(fromHalf(bits)), bits);
    ASSERT_EQ(toHalf(fromHalf(bits | 0x8000)), bits | 0x8000);
  }
}

TEST(HalfFloat, RandomFloats_RoundToTheNearest) {
  std::mt19937 random(3);
  for (int i = 0; i < 200000; ++i) {
    // Exponents from far below the least denormal to above the greatest half.
    const float value =
        std::ldexp(std::uniform_real_distribution<float>(1, 2)(random), int(random() % 48) - 30);
    ASSERT_EQ(toHalf(value), nearestHalf(value)) << value;
    ASSERT_EQ(toHalf(-value), nearestHalf(value) | 0x8000) << value;
  }
}

TEST(HalfFloat, MiddlesBetweenHalves_GoToTheEvenOne) {
  for (std::uint16_t half = 0; half < infinity - 1; ++half) {
    const auto middle =
        static_cast<float>(0.5 * (valueOf(half) + valueOf(static_cast<std::uint16_t>(half + 1))));
    ASSERT_EQ(toHalf(middle), half % 2 == 0 ? half : half + 1) << half;
    ASSERT_EQ(toHalf(std::nextafter(middle, 0.0f)), half);
    ASSERT_EQ(toHalf(std::nextafter(middle, 1e9f)), half + 1);
  }
}

TEST(HalfFloat, BeyondTheRange_IsInfinityAndNaNStays) {
  EXPECT_EQ(toHalf(65519.996f), infinity - 1);
  EXPECT_EQ(toHalf(65520.0f), infinity);
  EXPECT_EQ(toHalf(1e30f), infinity);
  EXPECT_EQ(toHalf(-std::numeric_limits<float>::infinity()), infinity | 0x8000);
  EXPECT_TRUE(std::isinf(fromHalf(infinity)));
  EXPECT_TRUE(std::isnan(fromHalf(toHalf(std::numeric_limits<float>::quiet_NaN()))));
}

}  // namespace
}  // namespace prelight
