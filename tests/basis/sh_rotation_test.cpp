#include "basis/sh_rotation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "basis/ch.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_projection.h"
#include "prelight/error.h"

namespace prelight {
namespace {

std::vector<double> seriesToRotate(int order, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> out(sh::coefficientCount(order));
  for (double& v : out) v = normal(random);
  return out;
}

glm::dmat3 randomRotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const glm::dvec4 q =
      glm::normalize(glm::dvec4(normal(random), normal(random), normal(random), normal(random)));
  const glm::dvec3 v(q.x, q.y, q.z);
  const glm::dmat3 cross(0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0);
  return glm::dmat3(1.0) + 2.0 * q.w * cross + 2.0 * cross * cross;
}

double worstOfSeries(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

/// The 48 rotations and mirrors that permute the axes and flip them.
std::vector<glm::dmat3> axisAlignedMatrices() {
  const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  std::vector<glm::dmat3> out;
  for (const auto& order : orders) {
    for (int signs = 0; signs < 8; ++signs) {
      glm::dmat3 matrix(0.0);
      for (int c = 0; c < 3; ++c) matrix[c][order[c]] = (signs >> c & 1) != 0 ? -1.0 : 1.0;
      out.push_back(matrix);
    }
  }
  return out;
}

TEST(ShRotation, RandomRotations_EveryOrderOfInterest_MatchTheQuadrature) {
  std::mt19937 random(1);
  for (const int order : {1, 2, 3, 6, 14, 32}) {
    const glm::dmat3 rotation = randomRotation(random);
    const auto f = seriesToRotate(order, order);
    std::vector<double> fast(f.size());
    sh::ShRotation(order, rotation).apply(f, fast);
    EXPECT_LT(worstOfSeries(fast, sh::rotate(f, order, rotation)), 1e-12) << order;
  }
}

TEST(ShRotation, AxisAlignedAndMirrored_MatchTheDirections) {
  constexpr int order = 32;
  const glm::dvec3 w = glm::normalize(glm::dvec3(0.6, -0.2, 0.4));
  std::vector<double> delta(order * order);
  std::vector<double> expected(order * order);
  std::vector<double> rotated(order * order);
  sh::evaluate(w, order, delta);
  for (const glm::dmat3& matrix : axisAlignedMatrices()) {
    sh::evaluate(matrix * w, order, expected);
    sh::ShRotation(order, matrix).apply(delta, rotated);
    EXPECT_LT(worstOfSeries(rotated, expected), 1e-12);
  }
}

TEST(ShRotation, AxisAlmostZ_LosesNothing) {
  constexpr int order = 32;
  const glm::dvec3 w = glm::normalize(glm::dvec3(0.6, -0.2, 0.4));
  std::vector<double> delta(order * order);
  std::vector<double> expected(order * order);
  std::vector<double> rotated(order * order);
  sh::evaluate(w, order, delta);
  for (const double tilt : {1e-3, 1e-7, 1e-12, 1e-16, 1e-300}) {
    for (const double side : {1.0, -1.0}) {
      const double c = std::cos(0.7);
      const double s = std::sin(0.7);
      const glm::dmat3 turn(c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0);
      const double cosine = side * std::cos(tilt);
      const glm::dmat3 lean(1.0, 0.0, 0.0, 0.0, cosine, std::sin(tilt), 0.0, -std::sin(tilt), cosine);
      const glm::dmat3 matrix = turn * lean;
      sh::evaluate(matrix * w, order, expected);
      sh::ShRotation(order, matrix).apply(delta, rotated);
      EXPECT_LT(worstOfSeries(rotated, expected), 1e-12) << tilt;
    }
  }
}

TEST(ShRotation, OfAProjectedFunction_IsTheProjectionOfTheRotatedFunction) {
  constexpr int order = 14;
  std::mt19937 random(4);
  const glm::dmat3 rotation = randomRotation(random);
  const auto f = [](const glm::dvec3& w) { return std::exp(2.0 * w.x - w.y) * std::sin(3.0 * w.z + 1.0); };
  const auto turned = [&](const glm::dvec3& w) { return f(glm::transpose(rotation) * w); };
  std::vector<double> rotated(order * order);
  sh::ShRotation(order, rotation).apply(sh::project(f, 60, order), rotated);
  EXPECT_LT(worstOfSeries(rotated, sh::project(turned, 60, order)), 1e-12);
}

/// Difference between 1000 successive rotations and one rotation by their product.
template <typename Number>
double driftAfterThousand(int order) {
  std::mt19937 random(5);
  auto f = seriesToRotate(order, 6);
  double square = 0.0;
  for (const double v : f) square += v * v;
  for (double& v : f) v /= std::sqrt(square);
  std::vector<Number> values(f.begin(), f.end());
  glm::dmat3 total(1.0);
  for (int i = 0; i < 1000; ++i) {
    const glm::dmat3 rotation = randomRotation(random);
    sh::ShRotation(order, rotation).apply(std::span<const Number>(values), std::span<Number>(values));
    total = rotation * total;
  }
  std::vector<double> expected(f.size());
  sh::ShRotation(order, total).apply(f, expected);
  double difference = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) difference += std::pow(values[i] - expected[i], 2);
  return std::sqrt(difference);
}

TEST(ShRotation, ThousandSuccessive_LargestOrder_DoNotDrift) {
  EXPECT_LT(driftAfterThousand<double>(sh::maxOrder), 1e-11);
  EXPECT_LT(driftAfterThousand<float>(sh::maxOrder), 1e-5);
}

// A device computes in this way: the matrices of the bands are rounded to float, and sums are in float.
TEST(ShRotation, ThousandSuccessive_MatricesAndSumsInFloat_DoNotDrift) {
  constexpr int order = sh::maxOrder;
  std::mt19937 random(5);
  const auto f = seriesToRotate(order, 6);
  std::vector<float> values(f.begin(), f.end());
  glm::dmat3 total(1.0);
  for (int i = 0; i < 1000; ++i) {
    const glm::dmat3 matrix = randomRotation(random);
    const sh::ShRotation rotation(order, matrix);
    for (int l = 0; l < order; ++l) {
      const auto band = rotation.bandMatrix(l);
      const int width = 2 * l + 1;
      const std::vector<float> before(values.begin() + l * l, values.begin() + l * l + width);
      for (int m = 0; m < width; ++m) {
        float sum = 0.0f;
        for (int k = 0; k < width; ++k) sum += static_cast<float>(band[m * width + k]) * before[k];
        values[l * l + m] = sum;
      }
    }
    total = matrix * total;
  }
  std::vector<double> expected(f.size());
  sh::ShRotation(order, total).apply(f, expected);
  double difference = 0.0;
  double norm = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    difference += std::pow(values[i] - expected[i], 2);
    norm += f[i] * f[i];
  }
  EXPECT_LT(std::sqrt(difference / norm), 1e-5);
}

TEST(ShRotation, BandMatrix_IsOrthogonalAndWhatApplyDoes) {
  constexpr int order = 7;
  std::mt19937 random(9);
  const sh::ShRotation rotation(order, randomRotation(random));
  const auto f = seriesToRotate(order, 1);
  std::vector<double> expected(f.size());
  rotation.apply(f, expected);
  for (int l = 0; l < order; ++l) {
    const auto matrix = rotation.bandMatrix(l);
    const int width = 2 * l + 1;
    for (int m = 0; m < width; ++m) {
      double value = 0.0;
      double norm = 0.0;
      for (int k = 0; k < width; ++k) {
        value += matrix[m * width + k] * f[l * l + k];
        norm += matrix[m * width + k] * matrix[m * width + k];
      }
      EXPECT_NEAR(value, expected[l * l + m], 1e-13);
      EXPECT_NEAR(norm, 1.0, 1e-13);
    }
  }
}

TEST(ShRotation, SeveralFunctionsAtOnce_AreRotatedEach) {
  constexpr int order = 4;
  std::mt19937 random(2);
  const sh::ShRotation rotation(order, randomRotation(random));
  const auto f = seriesToRotate(order, 1);
  const auto g = seriesToRotate(order, 2);
  std::vector<double> both(f);
  both.insert(both.end(), g.begin(), g.end());
  rotation.apply(both, both);
  std::vector<double> single(g.size());
  rotation.apply(g, single);
  for (std::size_t i = 0; i < g.size(); ++i) EXPECT_EQ(both[g.size() + i], single[i]);
}

TEST(ShRotation, OfChCoefficients_RotatesTheFunction) {
  constexpr int order = 14;
  std::mt19937 random(3);
  const glm::dmat3 matrix = randomRotation(random);
  const ch::Basis basis(order);
  const auto a = seriesToRotate(order, 3);
  std::vector<double> rotated(a.size());
  basis.rotate(sh::ShRotation(order, matrix), a, rotated);
  std::vector<double> values(a.size());
  std::vector<double> turned(a.size());
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 w = randomRotation(random)[0];
    ch::evaluate(w, order, values);
    ch::evaluate(matrix * w, order, turned);
    double before = 0.0;
    double after = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      before += a[k] * values[k];
      after += rotated[k] * turned[k];
    }
    EXPECT_NEAR(after, before, 1e-11);
  }
}

TEST(ShRotation, MatricesThatAreNoRotations_AreUsageErrors) {
  EXPECT_THROW(sh::ShRotation(0, glm::dmat3(1.0)), UsageError);
  EXPECT_THROW(sh::ShRotation(33, glm::dmat3(1.0)), UsageError);
  EXPECT_THROW(sh::ShRotation(3, glm::dmat3(2.0)), UsageError);
  EXPECT_THROW(sh::ShRotation(3, glm::dmat3(0.0)), UsageError);
  glm::dmat3 matrix(1.0);
  matrix[1][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(sh::ShRotation(3, matrix), UsageError);
}

}  // namespace
}  // namespace prelight
