#include "occluders/occluder_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace prelight {
namespace {

/// Midpoint sum over the hemisphere, with cells that are even in the squared cosine and in the angle: all
/// have the same weight.
double byQuadrature(double cosine, double sine) {
  constexpr int rings = 1500, sectors = 1500;
  const double across = std::sqrt(1.0 - cosine * cosine), least = std::sqrt(1.0 - sine * sine);
  int inside = 0;
  for (int i = 0; i < rings; ++i) {
    const double up = std::sqrt((i + 0.5) / rings), out = std::sqrt(1.0 - up * up);
    for (int j = 0; j < sectors; ++j)
      inside += up * cosine + out * std::cos(2.0 * std::numbers::pi * (j + 0.5) / sectors) * across > least;
  }
  return inside / (double(rings) * sectors);
}

TEST(BallFormFactor, AnyHeightAndSize_IsTheShareOfTheSky) {
  for (const double cosine : {-0.6, -0.3, -0.05, 0.0, 0.1, 0.4, 0.8, 1.0})
    for (const double sine : {0.05, 0.3, 0.7, 0.95})
      EXPECT_NEAR(ballFormFactor(cosine, sine), byQuadrature(cosine, sine), 5e-4) << cosine << " " << sine;
}

TEST(BallFormFactor, BelowTheHorizonOrWithoutSize_IsNone) {
  EXPECT_EQ(ballFormFactor(-0.5, 0.4), 0.0);
  EXPECT_EQ(ballFormFactor(0.5, 0.0), 0.0);
}

TEST(BallFormFactor, WhereTheHorizonTouches_HasNoStep) {
  for (const double sine : {0.1, 0.5, 0.9})
    for (const double side : {-1.0, 1.0})
      EXPECT_NEAR(ballFormFactor(side * sine - 1e-7, sine), ballFormFactor(side * sine + 1e-7, sine), 1e-6);
}

}  // namespace
}  // namespace prelight
