#include "benchmarks/lab/ball_shadow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "basis/quadrature.h"
#include "basis/sh.h"

namespace prelight {
namespace {

using std::numbers::pi;

constexpr double degree = pi / 180.0;

// The hidden part is an integral over the ball's cap, by a quadrature about its axis that is exact for the
// harmonics.
TEST(BallShadow, Transfer_IsTheOpenOneLessTheIntegralOverTheBall) {
  constexpr int order = 8, turns = 64;
  for (const double distance : {0.0, 0.3, 1.2}) {
    const double away = std::hypot(distance, 1.0), least = std::sqrt(1.0 - 0.16 / (away * away));
    const glm::dvec3 axis = glm::dvec3(distance, 0.0, 1.0) / away, across(axis.z, 0.0, -axis.x);
    std::vector<double> hidden(order), values(order * order);
    for (const LineSample& s : gaussLegendre(24)) {
      const double along = 0.5 * (1.0 + least) + 0.5 * (1.0 - least) * s.position;
      for (int k = 0; k < turns; ++k) {
        const double angle = 2.0 * pi * k / turns, out = std::sqrt(1.0 - along * along);
        const glm::dvec3 w =
            along * axis + out * (std::cos(angle) * across + glm::dvec3(0.0, std::sin(angle), 0.0));
        sh::evaluate(w, order, values);
        for (int l = 0; l < order; ++l)
          hidden[l] += 0.5 * (1.0 - least) * s.weight * 2.0 * pi / turns * w.z * values[l * (l + 1)];
      }
    }
    const std::vector<double> transfer = ball_shadow::transfer(distance, order);
    for (int l = 0; l < order; ++l) {
      const double open = pi * sh::clampedCosine(l) * std::sqrt((2.0 * l + 1.0) / (4.0 * pi));
      EXPECT_NEAR(transfer[l], open - hidden[l], 1e-12) << distance << " " << l;
    }
  }
}

TEST(BallShadow, Exact_OfAPoint_EndsAtTheBallsRim_AndOfADiskIsItsVisiblePart) {
  EXPECT_EQ(ball_shadow::exact(0.39, 0.0), 0.0);
  EXPECT_EQ(ball_shadow::exact(0.41, 0.0), 1.0);
  EXPECT_EQ(ball_shadow::exact(1.5, 20.0 * degree), 1.0);
  // Below the ball, which hides the middle of a larger light: the hidden share is sin^2 of the ball over that
  // of the light.
  EXPECT_NEAR(ball_shadow::exact(0.0, 100.0 * degree), 1.0 - 0.16 / std::pow(std::sin(50.0 * degree), 2.0),
              1e-3);
}

// As the slides found: few harmonics are enough for large lights, and no number of them for points.
TEST(BallShadow, Error_FallsWithTheOrder_TheFasterTheLargerTheLight) {
  for (const double angle : {0.0, 20.0, 40.0})
    EXPECT_LT(ball_shadow::error(angle * degree, 10), ball_shadow::error(angle * degree, 5)) << angle;
  for (const int order : {5, 10, 16})
    EXPECT_LT(ball_shadow::error(40.0 * degree, order), ball_shadow::error(0.0, order)) << order;
  EXPECT_LT(ball_shadow::error(40.0 * degree, 24), 0.01);
  EXPECT_GT(ball_shadow::error(0.0, 24), 0.05);
}

}  // namespace
}  // namespace prelight
