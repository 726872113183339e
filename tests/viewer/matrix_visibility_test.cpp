// Visibility of single directions by glossy matrices, against sums over the sphere.
#include "viewer/techniques/glossy/matrix_visibility.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "basis/quadrature.h"
#include "basis/sh.h"

namespace prelight {
namespace {

using std::numbers::pi;
using viewer::MatrixVisibility;

/// Rows M y of the matrix of a receiver with the normal z that sees the directions with x < limit.
std::vector<glm::dvec3> matrixRowsOf(int order, double limit, const std::vector<double>& y) {
  std::vector<glm::dvec3> rows(y.size(), glm::dvec3(0.0));
  std::vector<double> basis(y.size());
  for (const SphereSample& s : sphereQuadrature(200)) {
    if (s.direction.z <= 0.0 || s.direction.x >= limit) continue;
    sh::evaluate(s.direction, order, basis);
    double sum = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) sum += basis[i] * y[i];
    for (std::size_t i = 0; i < y.size(); ++i)
      rows[i] += glm::dvec3(s.weight * s.direction.z / pi * sum * basis[i]);
  }
  return rows;
}

TEST(MatrixVisibility, OpenReceiver_HasTheMeanOfItsMatrix) {
  for (const int order : {1, 3, 5})
    for (const double angle : {0.0, 0.7, 1.5, 2.4}) {
      std::vector<double> y(static_cast<std::size_t>(order * order));
      sh::evaluate({std::sin(angle), 0.0, std::cos(angle)}, order, y);
      const double mean = MatrixVisibility::mean(matrixRowsOf(order, 2.0, y), y).x;
      EXPECT_NEAR(MatrixVisibility(order).open(std::cos(angle)), mean, 2e-4) << order << " " << angle;
    }
}

/// The other half of what is hidden is what is seen.
TEST(MatrixVisibility, HalfOfTheSkyHidden_IsASmoothStepWithoutRinging) {
  constexpr int order = 4;
  const MatrixVisibility open(order);
  std::vector<double> y(order * order);
  const auto share = [&](double angle) {
    const glm::dvec3 w(std::sin(angle), 0.0, std::cos(angle));
    sh::evaluate(w, order, y);
    return MatrixVisibility::mean(matrixRowsOf(order, 0.0, y), y).x / open.open(w.z);
  };
  EXPECT_NEAR(share(0.0), 0.5, 4e-3);
  for (double angle = 0.1; angle <= 1.5; angle += 0.1) {
    EXPECT_GE(share(angle), 0.0);
    EXPECT_NEAR(share(angle) + share(-angle), 1.0, 8e-3) << angle;
    if (angle < 0.75) {
      EXPECT_LT(share(angle), share(angle - 0.1)) << angle;
    }
  }
  EXPECT_GT(share(-0.6), 0.9);
  EXPECT_LT(share(0.6), 0.1);
}

}  // namespace
}  // namespace prelight
