#include "basis/sh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "basis/quadrature.h"
#include "prelight/error.h"

namespace prelight {
namespace {

using std::numbers::pi;

double worstGramError(int order) {
  const int count = sh::coefficientCount(order);
  std::vector<double> gram(static_cast<std::size_t>(count) * count, 0.0);
  std::vector<double> values(count);
  for (const SphereSample& s : sphereQuadrature(2 * order - 2)) {
    sh::evaluate(s.direction, order, values);
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j <= i; ++j) gram[i * count + j] += s.weight * values[i] * values[j];
    }
  }
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j <= i; ++j)
      worst = std::max(worst, std::abs(gram[i * count + j] - (i == j ? 1.0 : 0.0)));
  }
  return worst;
}

TEST(Sh, Evaluate_Order8_IsOrthonormal) { EXPECT_LT(worstGramError(8), 1e-13); }

TEST(Sh, Evaluate_LargestOrder_IsOrthonormal) { EXPECT_LT(worstGramError(sh::maxOrder), 1e-13); }

TEST(Sh, Evaluate_FirstBand_IsYZX) {
  std::array<double, 4> values{};
  const glm::dvec3 w = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  sh::evaluate(w, 2, values);
  EXPECT_NEAR(values[0], std::sqrt(0.25 / pi), 1e-15);
  const double factor = std::sqrt(0.75 / pi);
  EXPECT_NEAR(values[1], factor * w.y, 1e-15);
  EXPECT_NEAR(values[2], factor * w.z, 1e-15);
  EXPECT_NEAR(values[3], factor * w.x, 1e-15);
}

TEST(Sh, Evaluate_SecondBand_MatchesPolynomials) {
  std::array<double, 9> values{};
  const glm::dvec3 w = glm::normalize(glm::dvec3(-0.4, 0.7, 0.2));
  sh::evaluate(w, 3, values);
  const double factor = 0.5 * std::sqrt(15.0 / pi);
  EXPECT_NEAR(values[4], factor * w.x * w.y, 1e-15);
  EXPECT_NEAR(values[5], factor * w.y * w.z, 1e-15);
  EXPECT_NEAR(values[6], 0.25 * std::sqrt(5.0 / pi) * (3.0 * w.z * w.z - 1.0), 1e-15);
  EXPECT_NEAR(values[7], factor * w.x * w.z, 1e-15);
  EXPECT_NEAR(values[8], 0.5 * factor * (w.x * w.x - w.y * w.y), 1e-15);
}

// Golden vector for the direction (2, 3, 6) / 7, computed by an independent implementation (Python, same
// convention).
TEST(Sh, Evaluate_Order5_MatchesGoldenVector) {
  constexpr std::array<double, 25> golden = {
      0.28209479177387814,   0.20940107652982282,  0.4188021530596456,   0.13960071768654855,
      0.13378144048066273,   0.4013443214419882,   0.3797571908142587,   0.26756288096132547,
      -0.05574226686694281,  0.015482193321690353, 0.3033877898981339,   0.5236705515729885,
      0.21541957391499358,   0.34911370104865896,  -0.1264115791242225,  -0.0791312103108618,
      -0.0312787539583095,   0.0398113542557752,   0.47998366490325195,  0.5266547135873707,
      -0.015729046334330837, 0.35110314239158047,  -0.19999319370968832, -0.20348025508507323,
      -0.03101809767532359};
  std::array<double, 25> values{};
  sh::evaluate(glm::dvec3(2.0, 3.0, 6.0) / 7.0, 5, values);
  for (std::size_t i = 0; i < golden.size(); ++i) EXPECT_NEAR(values[i], golden[i], 1e-14) << i;
}

TEST(Sh, Evaluate_AtThePoles_OnlyZonalTermsRemain) {
  std::vector<double> values(sh::coefficientCount(sh::maxOrder));
  for (const double z : {1.0, -1.0}) {
    sh::evaluate(glm::dvec3(0.0, 0.0, z), sh::maxOrder, values);
    for (int l = 0; l < sh::maxOrder; ++l) {
      for (int m = -l; m <= l; ++m) {
        const double sign = z < 0.0 && l % 2 == 1 ? -1.0 : 1.0;
        const double expected = m == 0 ? sign * std::sqrt((2.0 * l + 1.0) / (4.0 * pi)) : 0.0;
        EXPECT_NEAR(values[l * (l + 1) + m], expected, 1e-13) << l << " " << m;
      }
    }
  }
}

/// Zonal coefficient of the clamped cosine over the norm of Y_l0: 2 pi / pi times the integral of z P_l(z)
/// over [0, 1], by quadrature.
double clampedCosineByQuadrature(int band) {
  double sum = 0.0;
  for (const LineSample& s : gaussLegendre(40)) {
    const double z = 0.5 * (s.position + 1.0);
    double before = 0.0;
    double p = 1.0;
    for (int l = 1; l <= band; ++l) {
      const double next = ((2.0 * l - 1.0) * z * p - (l - 1.0) * before) / l;
      before = p;
      p = next;
    }
    sum += 0.5 * s.weight * z * p;
  }
  return 2.0 * sum;
}

TEST(Sh, ClampedCosine_EveryBand_MatchesQuadrature) {
  for (int band = 0; band < sh::maxOrder; ++band) {
    EXPECT_NEAR(sh::clampedCosine(band), clampedCosineByQuadrature(band), 1e-14) << band;
  }
}

TEST(Sh, ClampedCosine_OddBandsAboveOne_AreExactlyZero) {
  for (int band = 3; band < 100; band += 2) EXPECT_EQ(sh::clampedCosine(band), 0.0) << band;
}

TEST(OpenTowards, EveryOrder_IsTheSeriesOfTheOpenTransfer) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  for (const int order : {1, 2, 3, 6, 13}) {
    const auto count = static_cast<std::size_t>(order * order);
    std::vector<double> open(count), values(count);
    sh::openTransfer(normal, order, open);
    for (const glm::dvec3& way : {glm::dvec3(0.1, 0.2, 0.9), glm::dvec3(0.6, 0.6, 0.1), -normal, normal}) {
      const glm::dvec3 w = glm::normalize(way);
      sh::evaluate(w, order, values);
      double sum = 0.0;
      for (std::size_t i = 0; i < count; ++i) sum += open[i] * values[i];
      EXPECT_NEAR(sh::openTowards(glm::dot(normal, w), order), sum, 1e-13) << order;
    }
  }
}

TEST(Sh, OpenTransfer_HighOrder_ReconstructsTheClampedCosine) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, 0.9, -0.3));
  std::vector<double> transfer(sh::coefficientCount(sh::maxOrder));
  std::vector<double> values(transfer.size());
  sh::openTransfer(normal, sh::maxOrder, transfer);
  for (const SphereSample& s : sphereQuadrature(8)) {
    sh::evaluate(s.direction, sh::maxOrder, values);
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += transfer[i] * values[i];
    EXPECT_NEAR(sum, std::max(glm::dot(normal, s.direction), 0.0) / pi, 4e-3);
  }
}

TEST(Sh, Rotate_PointEvaluation_FollowsTheDirection) {
  constexpr int order = 8;
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const glm::dmat3 turn = glm::dmat3(c, 0, -s, 0, 1, 0, s, 0, c) * glm::dmat3(1, 0, 0, 0, s, c, 0, -c, s);
  const glm::dvec3 w = glm::normalize(glm::dvec3(0.6, -0.2, 0.4));
  std::vector<double> delta(order * order);
  std::vector<double> expected(order * order);
  sh::evaluate(w, order, delta);
  sh::evaluate(turn * w, order, expected);
  const auto rotated = sh::rotate(delta, order, turn);
  for (int i = 0; i < order * order; ++i) EXPECT_NEAR(rotated[i], expected[i], 1e-13) << i;
}

TEST(Sh, EvaluateDerivative_LargestOrder_MatchesDifferences) {
  const glm::dvec3 w = glm::normalize(glm::dvec3(0.6, -0.2, 0.4));
  const glm::dvec3 t = glm::normalize(glm::cross(w, glm::dvec3(0.1, 0.7, 0.3)));
  constexpr int count = sh::maxOrder * sh::maxOrder;
  constexpr double step = 1e-5;
  std::vector<double> slope(count);
  std::vector<double> ahead(count);
  std::vector<double> behind(count);
  sh::evaluateDerivative(w, t, sh::maxOrder, slope);
  sh::evaluate(std::cos(step) * w + std::sin(step) * t, sh::maxOrder, ahead);
  sh::evaluate(std::cos(step) * w - std::sin(step) * t, sh::maxOrder, behind);
  // Central differences are off by step^2 l^3 / 6 and by rounding of 1e-15 over the step.
  for (int i = 0; i < count; ++i) EXPECT_NEAR(slope[i], (ahead[i] - behind[i]) / (2.0 * step), 2e-6) << i;
}

TEST(Sh, BadOrders_AreUsageErrors) {
  std::vector<double> values(4);
  EXPECT_THROW(sh::evaluate({0.0, 0.0, 1.0}, 0, values), UsageError);
  EXPECT_THROW(sh::evaluate({0.0, 0.0, 1.0}, 33, values), UsageError);
  EXPECT_THROW(sh::evaluateDerivative({0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}, -1, values), UsageError);
  EXPECT_THROW(sh::openTransfer({0.0, 0.0, 1.0}, 33, values), UsageError);
  EXPECT_THROW(sh::reconstruct(values, 33, {0.0, 0.0, 1.0}), UsageError);
}

}  // namespace
}  // namespace prelight
