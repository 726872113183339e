#include "basis/ch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "basis/quadrature.h"
#include "basis/sh.h"
#include "prelight/error.h"

namespace prelight {
namespace {

using std::numbers::pi;

double sum(const std::vector<double>& a, const std::vector<double>& b) {
  double total = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) total += a[i] * b[i];
  return total;
}

double reconstruct(const std::vector<double>& coefficients, int order, const glm::dvec3& direction) {
  std::vector<double> values(coefficients.size());
  ch::evaluate(direction, order, values);
  return sum(coefficients, values);
}

/// Relative L2 distance on the sphere between the clamped cosine about a normal and a sum of CH.
double clampedCosineError(const std::vector<double>& coefficients, int order, const glm::dvec3& normal) {
  double difference = 0.0;
  double norm = 0.0;
  for (const SphereSample& s : sphereQuadrature(200)) {
    const double expected = std::max(glm::dot(normal, s.direction), 0.0);
    const double error = reconstruct(coefficients, order, s.direction) - expected;
    difference += s.weight * error * error;
    norm += s.weight * expected * expected;
  }
  return std::sqrt(difference / norm);
}

TEST(Ch, Constant_Zonal_MatchesTheClosedForm) {
  for (int l = 0; l < ch::maxOrder; ++l) {
    const double l2 = static_cast<double>(l) * l;
    const double expected = std::sqrt((2.0 * l + 1.0) / (4.0 * pi) * (2.0 * l - 1.0) / (2.0 * l2 - 1.0));
    EXPECT_NEAR(ch::constant(l, 0), expected, 1e-14) << l;
  }
}

// The functions themselves are squared and summed by a quadrature rule that is exact for them.
TEST(Ch, Constants_OfEveryFunction_MakeItsNormOne) {
  std::vector<double> values(ch::maxOrder * ch::maxOrder), norms(values.size());
  for (const SphereSample& sample : sphereQuadrature(2 * ch::maxOrder)) {
    ch::evaluate(sample.direction, ch::maxOrder, values);
    for (std::size_t i = 0; i < values.size(); ++i) norms[i] += sample.weight * values[i] * values[i];
  }
  for (const double norm : norms) EXPECT_NEAR(norm, 1.0, 1e-12);
}

/// Coefficients of powers of z of the m-th derivative of T_l, exact in double: integers below 2^53.
std::vector<double> chebyshevDerivative(int l, int m) {
  std::vector<double> before = {1.0}, now = {0.0, 1.0};
  if (l == 0) now = before;
  for (int k = 2; k <= l; ++k) {
    std::vector<double> next(static_cast<std::size_t>(k) + 1, 0.0);
    for (std::size_t i = 0; i < now.size(); ++i) next[i + 1] += 2.0 * now[i];
    for (std::size_t i = 0; i < before.size(); ++i) next[i] -= before[i];
    before = now;
    now = next;
  }
  for (int k = 0; k < m; ++k) {
    for (std::size_t i = 1; i < now.size(); ++i) now[i - 1] = static_cast<double>(i) * now[i];
    now.pop_back();
  }
  return now;
}

// Eq. 6.11 as written, integrated by a rule that is exact for it, without recurrence or closed form.
TEST(Ch, Constants_ToBandTwelve_AreThoseOfIntegralsOfThePolynomials) {
  for (int l = 0; l <= 12; ++l)
    for (int m = 0; m <= l; ++m) {
      const std::vector<double> polynomial = chebyshevDerivative(l, m);
      double integral = 0.0;
      for (const LineSample& s : gaussLegendre(16)) {
        double value = 0.0;
        for (std::size_t i = polynomial.size(); i-- > 0;) value = value * s.position + polynomial[i];
        integral += s.weight * std::pow(1.0 - s.position * s.position, m) * value * value;
      }
      const double expected = 1.0 / std::sqrt((m == 0 ? 2.0 : 1.0) * pi * integral);
      EXPECT_NEAR(ch::constant(l, m) / expected, 1.0, 1e-11) << l << " " << m;
    }
}

// [1] A.1, entries of bands 2, 5 and 13.
TEST(Ch, Constants_AreThoseThatTheThesisFoundByIntegration) {
  const struct {
    int l, m;
    double value;
  } printed[] = {{2, 1, 2.731371076e-1},   {2, 2, 1.365685538e-1},  {5, 3, 4.562170666e-3},
                 {5, 5, 3.418656546e-4},   {13, 1, 4.336708685e-2}, {13, 6, 1.286657036e-7},
                 {13, 13, 3.199564996e-14}};
  for (const auto& [l, m, value] : printed)
    EXPECT_NEAR(ch::constant(l, m) / value, 1.0, 1e-9) << l << " " << m;
}

TEST(Ch, Constant_Sectoral_IsThatOfSphericalHarmonics) {
  // C_ll and Y_ll are both sin^l times a wave of norm 1; T_l^(l) = 2^(l-1) l!, and
  // Y_ll = sqrt(2 (2l+1)!! / (2l)!! / 4 pi) sin^l cos(l phi).
  double norm2 = 2.0 / (4.0 * pi);
  double derivative = 1.0;
  for (int l = 1; l < ch::maxOrder; ++l) {
    norm2 *= (2.0 * l + 1.0) / (2.0 * l);
    if (l > 1) derivative *= 2.0 * l;
    EXPECT_NEAR(ch::constant(l, -l) * derivative / std::sqrt(norm2), 1.0, 1e-13) << l;
  }
}

TEST(Ch, Evaluate_Order4_MatchesDerivativesOfChebyshevPolynomials) {
  const glm::dvec3 w = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  const double z = w.z;
  const double s = std::sqrt(1.0 - z * z);
  const double phi = std::atan2(w.y, w.x);
  const double chebyshev[4][4] = {{1.0, 0, 0, 0},
                                  {z, 1.0, 0, 0},
                                  {2 * z * z - 1, 4 * z, 4.0, 0},
                                  {4 * z * z * z - 3 * z, 12 * z * z - 3, 24 * z, 24.0}};
  std::vector<double> values(16);
  ch::evaluate(w, 4, values);
  for (int l = 0; l < 4; ++l) {
    for (int m = -l; m <= l; ++m) {
      const int k = std::abs(m);
      const double wave = m < 0 ? std::sin(k * phi) : std::cos(k * phi);
      EXPECT_NEAR(values[l * (l + 1) + m], ch::constant(l, m) * std::pow(s, k) * chebyshev[l][k] * wave,
                  1e-14)
          << l << " " << m;
    }
  }
}

TEST(Ch, Gram_Order14_MatchesQuadrature) {
  constexpr int order = 14;
  const ch::Basis basis(order);
  constexpr int count = order * order;
  std::vector<double> gram(count * count, 0.0);
  std::vector<double> values(count);
  for (const SphereSample& s : sphereQuadrature(2 * order - 2)) {
    ch::evaluate(s.direction, order, values);
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) gram[i * count + j] += s.weight * values[i] * values[j];
    }
  }
  for (int i = 0; i < count; ++i) {
    EXPECT_NEAR(gram[i * count + i], 1.0, 1e-13) << i;
    for (int j = 0; j < count; ++j)
      EXPECT_NEAR(basis.gram(i, j), gram[i * count + j], 1e-13) << i << " " << j;
  }
}

TEST(Ch, Gram_OverlapsThatTheLiteratureDenies_AreThere) {
  const ch::Basis basis(4);
  // C_00 C_20 integrates to 2 pi K_00 K_20 integral (2 z^2 - 1) dz = -4 pi / 3 K_00 K_20.
  EXPECT_NEAR(basis.gram(0, 6), -4.0 * pi / 3.0 * ch::constant(0, 0) * ch::constant(2, 0), 1e-14);
  EXPECT_LT(basis.gram(0, 6), -0.48);
}

TEST(Ch, Maps_ThereAndBack_AreExactAtEveryOrder) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const int order : {1, 2, 5, 14, 32}) {
    const ch::Basis basis(order);
    std::vector<double> y(sh::coefficientCount(order));
    for (double& v : y) v = normal(random);
    std::vector<double> a(y.size());
    std::vector<double> back(y.size());
    basis.fromSh(y, a);
    basis.toSh(a, back);
    for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(back[i], y[i], 1e-13) << order << " " << i;
    std::vector<double> moments(y.size());
    basis.momentsFromSh(y, moments);
    basis.shFromMoments(moments, back);
    for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(back[i], y[i], 1e-12) << order << " " << i;
    basis.dualFromMoments(moments, back);
    for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(back[i], a[i], 1e-12) << order << " " << i;
    basis.momentsFromDual(a, back);
    for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(back[i], moments[i], 1e-12) << order << " " << i;
  }
}

TEST(Ch, FromSh_EveryOrder_IsTheSameFunction) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int order = 1; order <= ch::maxOrder; order += 1) {
    const ch::Basis basis(order);
    std::vector<double> y(sh::coefficientCount(order));
    for (double& v : y) v = normal(random);
    std::vector<double> a(y.size());
    basis.fromSh(y, a);
    for (const SphereSample& s : sphereQuadrature(4)) {
      EXPECT_NEAR(reconstruct(a, order, s.direction), sh::reconstruct(y, order, s.direction), 1e-11) << order;
    }
  }
}

TEST(Ch, MomentsTimesCoefficients_IsTheIntegralOfTheProduct) {
  constexpr int order = 6;
  const ch::Basis basis(order);
  std::vector<double> transfer(order * order);
  std::vector<double> light(order * order);
  sh::openTransfer(glm::normalize(glm::dvec3(0.2, 0.9, -0.3)), order, transfer);
  sh::evaluate(glm::normalize(glm::dvec3(-0.5, 0.4, 0.7)), order, light);
  std::vector<double> a(transfer.size());
  std::vector<double> p(light.size());
  basis.fromSh(transfer, a);
  basis.momentsFromSh(light, p);
  EXPECT_NEAR(sum(a, p), sum(transfer, light), 1e-14);
}

TEST(Ch, Moments_AreInnerProductsWithTheFunctions) {
  constexpr int order = 5;
  const ch::Basis basis(order);
  std::vector<double> y(order * order);
  sh::openTransfer(glm::normalize(glm::dvec3(1.0, 2.0, 3.0)), order, y);
  std::vector<double> moments(y.size());
  basis.momentsFromSh(y, moments);
  std::vector<double> expected(y.size(), 0.0);
  std::vector<double> values(y.size());
  for (const SphereSample& s : sphereQuadrature(2 * order - 2)) {
    ch::evaluate(s.direction, order, values);
    const double f = s.weight * sh::reconstruct(y, order, s.direction);
    for (std::size_t i = 0; i < y.size(); ++i) expected[i] += f * values[i];
  }
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(moments[i], expected[i], 1e-14) << i;
}

TEST(Ch, ClampedCosine_Order14_NaiveIsFarOffAndDualIsAsSh) {
  constexpr int order = 14;
  const ch::Basis basis(order);
  const glm::dvec3 normal(0.0, 0.0, 1.0);
  std::vector<double> y(order * order);
  sh::openTransfer(normal, order, y);
  for (double& v : y) v *= pi;
  std::vector<double> dual(y.size());
  std::vector<double> naive(y.size());
  basis.fromSh(y, dual);
  basis.momentsFromSh(y, naive);
  EXPECT_NEAR(clampedCosineError(naive, order, normal), 0.42, 0.01);
  EXPECT_LT(clampedCosineError(dual, order, normal), 0.012);
}

// Both projections sum over the same scattered samples, as a bake does, and are stored in float.
TEST(Ch, DualFromTheSameSamples_EveryOrderTo14_ReconstructsWhatShDoes) {
  for (int order = 1; order <= 14; ++order) {
    std::mt19937 random(order);
    std::normal_distribution<double> normal;
    const int count = order * order;
    std::vector<double> y(count, 0.0);
    std::vector<double> moments(count, 0.0);
    std::vector<double> values(count);
    constexpr int samples = 500;
    for (int s = 0; s < samples; ++s) {
      const glm::dvec3 w = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
      const double weight = 4.0 * pi / samples * std::max(w.x, 0.0) * (w.y > -0.3 ? 1.0 : 0.0);
      sh::evaluate(w, order, values);
      for (int i = 0; i < count; ++i) y[i] += weight * values[i];
      ch::evaluate(w, order, values);
      for (int i = 0; i < count; ++i) moments[i] += weight * values[i];
    }
    std::vector<double> dual(count);
    ch::Basis(order).dualFromMoments(moments, dual);
    const std::vector<float> stored(dual.begin(), dual.end());
    const std::vector<double> a(stored.begin(), stored.end());
    for (const SphereSample& s : sphereQuadrature(2 * order)) {
      EXPECT_NEAR(reconstruct(dual, order, s.direction), sh::reconstruct(y, order, s.direction), 1e-12)
          << order;
      EXPECT_NEAR(reconstruct(a, order, s.direction), sh::reconstruct(y, order, s.direction), 1e-6) << order;
    }
  }
}

TEST(Ch, Floats_MatchDoubles) {
  constexpr int order = 14;
  const ch::Basis basis(order);
  std::vector<double> y(order * order);
  sh::openTransfer(glm::normalize(glm::dvec3(0.2, 0.9, -0.3)), order, y);
  std::vector<float> in(y.begin(), y.end());
  std::vector<float> a(y.size());
  std::vector<float> back(y.size());
  basis.fromSh(in, a);
  basis.toSh(a, back);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(back[i], in[i], 1e-6) << i;
}

TEST(Ch, BadOrders_AreUsageErrors) {
  EXPECT_THROW(ch::Basis(0), UsageError);
  EXPECT_THROW(ch::Basis(33), UsageError);
  EXPECT_THROW(ch::constant(32, 0), UsageError);
  EXPECT_THROW(ch::constant(3, 4), UsageError);
  EXPECT_THROW(ch::step(32, 0), UsageError);
  EXPECT_THROW(ch::sectoral(32), UsageError);
}

}  // namespace
}  // namespace prelight
