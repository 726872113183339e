#include "basis/sh_products.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "basis/quadrature.h"
#include "prelight/error.h"

namespace prelight {
namespace {

std::vector<double> randomCoefficients(int order, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> out(sh::coefficientCount(order));
  for (double& v : out) v = normal(random);
  return out;
}

/// The integral of Y_i Y_j f by an exact quadrature.
std::vector<double> matrixByDefinition(const std::vector<double>& f, int fOrder, int order) {
  const int count = sh::coefficientCount(order);
  std::vector<double> out(static_cast<std::size_t>(count) * count, 0.0);
  std::vector<double> values(count);
  for (const SphereSample& s : sphereQuadrature(2 * (order - 1) + fOrder - 1)) {
    sh::evaluate(s.direction, order, values);
    const double value = s.weight * sh::reconstruct(f, fOrder, s.direction);
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) out[i * count + j] += value * values[i] * values[j];
    }
  }
  return out;
}

TEST(ShProducts, TripleProducts_KnownValues_MatchClosedForms) {
  const double y00 = 0.5 * std::sqrt(std::numbers::inv_pi);
  int found = 0;
  for (const TripleProduct& t : sh::tripleProducts(3, 3)) {
    if (t.i == 0) {
      EXPECT_EQ(t.j, t.k);
      EXPECT_NEAR(t.value, y00, 1e-15);
      ++found;
    }
    // The integral of Y_10 Y_10 Y_20 is 1 / sqrt(5 pi); with x x or y y in place of z z it is minus half of
    // that.
    const double expected =
        t.i == 2 ? 1.0 / std::sqrt(5.0 * std::numbers::pi) : -0.5 / std::sqrt(5.0 * std::numbers::pi);
    if ((t.i == 1 || t.i == 2) && t.j == t.i && t.k == 6) {
      EXPECT_NEAR(t.value, expected, 1e-15);
      ++found;
    }
  }
  EXPECT_EQ(found, 9 + 2);
}

TEST(ShProducts, Matrix_Orders1To8WithAllBandsOfF_MatchesTheDefinition) {
  for (int order = 1; order <= 8; ++order) {
    const int fOrder = 2 * order - 1;
    const auto f = randomCoefficients(fOrder, order);
    const auto expected = matrixByDefinition(f, fOrder, order);
    const auto matrix = sh::productMatrix(f, fOrder, order);
    ASSERT_EQ(matrix.size(), expected.size());
    for (std::size_t i = 0; i < matrix.size(); ++i)
      EXPECT_NEAR(matrix[i], expected[i], 1e-12) << order << " " << i;
  }
}

TEST(ShProducts, Matrix_FOfFewerOrMoreBandsThanMatter_MatchesTheDefinition) {
  for (const int fOrder : {1, 3, 12}) {
    const auto f = randomCoefficients(fOrder, 7);
    const auto expected = matrixByDefinition(f, fOrder, 4);
    const auto matrix = sh::productMatrix(f, fOrder, 4);
    for (std::size_t i = 0; i < matrix.size(); ++i)
      EXPECT_NEAR(matrix[i], expected[i], 1e-12) << fOrder << " " << i;
  }
}

TEST(ShProducts, Matrix_OfAConstant_IsTheIdentity) {
  std::vector<double> one(9, 0.0);
  one[0] = std::sqrt(4.0 * std::numbers::pi);
  const auto matrix = sh::productMatrix(one, 3, 5);
  for (int i = 0; i < 25; ++i) {
    for (int j = 0; j < 25; ++j) EXPECT_NEAR(matrix[i * 25 + j], i == j ? 1.0 : 0.0, 1e-14);
  }
}

TEST(ShProducts, Product_WithRoomForAllBands_IsTheProductEverywhere) {
  const auto f = randomCoefficients(4, 1);
  const auto g = randomCoefficients(6, 2);
  const auto h = sh::product(f, 4, g, 6, 9);
  for (const SphereSample& s : sphereQuadrature(6)) {
    const double expected = sh::reconstruct(f, 4, s.direction) * sh::reconstruct(g, 6, s.direction);
    EXPECT_NEAR(sh::reconstruct(h, 9, s.direction), expected, 1e-12);
  }
}

TEST(ShProducts, Multiply_MatchesMatrixAndQuadrature) {
  const auto f = randomCoefficients(7, 3);
  const auto g = randomCoefficients(5, 4);
  const sh::ShProduct product(5, 7);
  std::vector<double> out(25);
  product.multiply(f, g, out);
  const auto expected = sh::product(f, 7, g, 5, 5);
  const auto matrix = sh::productMatrix(f, 7, 5);
  for (int i = 0; i < 25; ++i) {
    double row = 0.0;
    for (int j = 0; j < 25; ++j) row += matrix[i * 25 + j] * g[j];
    EXPECT_NEAR(out[i], expected[i], 1e-12);
    EXPECT_NEAR(out[i], row, 1e-12);
  }
}

TEST(ShProducts, BadOrdersAndValues_AreUsageErrors) {
  std::vector<double> f(9, 1.0);
  EXPECT_THROW(sh::ShProduct(0, 3), UsageError);
  EXPECT_THROW(sh::ShProduct(3, 33), UsageError);
  EXPECT_THROW(sh::productMatrix(f, 2, 3), UsageError);
  EXPECT_THROW(sh::product(f, 3, f, 3, 33), UsageError);
  f[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(sh::productMatrix(f, 3, 3), UsageError);
}

}  // namespace
}  // namespace prelight
