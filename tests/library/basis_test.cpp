#include "prelight/basis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "prelight/prelight.h"

namespace prelight {
namespace {

using std::numbers::pi;

/// A quarter turn about z: x becomes y.
glm::dmat3 quarterTurn() { return {{0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}; }

/// The golden vector of docs/conventions.md. Directions need not have unit length.
TEST(BasisValues, OfTheGoldenDirection_AreThoseOfTheConventions) {
  const std::vector<glm::dvec3> directions{{1.0, 2.0, 3.0}};
  const std::vector<double> values = basisValues(HarmonicBasis::Sh, directions, 3);
  const double expected[] = {0.282094791774, 0.261169028265, 0.391753542398, 0.130584514133, 0.156078347227,
                             0.468235041682, 0.292863596306, 0.234117520841, -0.117058760421};
  ASSERT_EQ(values.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(values[i], expected[i], 1e-11);
}

TEST(SphereRuleOfADegree, IntegratesProductsOfFunctions) {
  const SphereRule rule = sphereRule(6);
  const std::vector<double> values = basisValues(HarmonicBasis::Sh, rule.directions, 4);
  for (std::size_t i = 0; i < 16; ++i)
    for (std::size_t j = 0; j < 16; ++j) {
      double sum = 0.0;
      for (std::size_t k = 0; k < rule.weights.size(); ++k)
        sum += rule.weights[k] * values[16 * k + i] * values[16 * k + j];
      EXPECT_NEAR(sum, i == j ? 1.0 : 0.0, 1e-12) << i << ", " << j;
    }
}

/// In either basis, the rotated function has at the rotated direction the value of the function at the
/// direction.
TEST(RotateHarmonics, OfTwoFunctions_TurnsBoth) {
  const std::vector<glm::dvec3> at{{0.3, -0.4, 0.8}}, turned{quarterTurn() * at[0]};
  std::vector<double> functions(18);
  for (std::size_t i = 0; i < 18; ++i) functions[i] = std::sin(1.0 + static_cast<double>(i));
  for (const HarmonicBasis basis : {HarmonicBasis::Sh, HarmonicBasis::Ch}) {
    const std::vector<double> rotated = rotateHarmonics(basis, functions, 3, quarterTurn());
    const std::vector<double> before = basisValues(basis, at, 3), after = basisValues(basis, turned, 3);
    for (std::size_t f = 0; f < 2; ++f) {
      double was = 0.0, is = 0.0;
      for (std::size_t i = 0; i < 9; ++i) {
        was += functions[9 * f + i] * before[i];
        is += rotated[9 * f + i] * after[i];
      }
      EXPECT_NEAR(is, was, 1e-12);
    }
  }
}

/// sum a_i C_i = sum y_i Y_i, and the integral of a product is sum a_i p_i.
TEST(ChFromSh, Function_IsTheSame) {
  std::vector<double> sh(16);
  for (std::size_t i = 0; i < 16; ++i) sh[i] = std::cos(static_cast<double>(i));
  const std::vector<double> ch = chFromSh(sh, 4), back = shFromCh(ch, 4), moments = chMomentsFromSh(sh, 4);
  const std::vector<glm::dvec3> at{{-0.2, 0.5, 0.3}};
  const std::vector<double> y = basisValues(HarmonicBasis::Sh, at, 4),
                            c = basisValues(HarmonicBasis::Ch, at, 4);
  double inSh = 0.0, inCh = 0.0, square = 0.0, product = 0.0;
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_NEAR(back[i], sh[i], 1e-12);
    inSh += sh[i] * y[i];
    inCh += ch[i] * c[i];
    square += sh[i] * sh[i];
    product += ch[i] * moments[i];
  }
  EXPECT_NEAR(inCh, inSh, 1e-12);
  EXPECT_NEAR(product, square, 1e-11);
}

TEST(ProjectSky, OfOneRadiance_IsItsMean) {
  const std::vector<double> light = projectSky(constantEnvironment({1.0f, 2.0f, 3.0f}), 3);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < 9; ++i)
      EXPECT_NEAR(light[9 * c + i], i == 0 ? (1.0 + double(c)) * std::sqrt(4.0 * pi) : 0.0, 1e-9);
}

TEST(Haar, ForwardAndInverse_GiveTheMapBack) {
  std::vector<float> maps(2 * 6 * 16);
  for (std::size_t i = 0; i < maps.size(); ++i) maps[i] = std::sin(0.37f * static_cast<float>(i));
  std::vector<float> values = maps;
  haarForward(values, 4);
  double before = 0.0, after = 0.0;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    before += double(maps[i]) * double(maps[i]);
    after += double(values[i]) * double(values[i]);
  }
  EXPECT_NEAR(after, before, 1e-4) << "wavelets are orthonormal";
  EXPECT_EQ(haarKept(std::span(values).first(96), 1.0).size(), 0u);
  haarInverse(values, 4);
  for (std::size_t i = 0; i < maps.size(); ++i) EXPECT_NEAR(values[i], maps[i], 1e-5f);
}

/// A quarter turn takes face +X to face +Y as a whole.
TEST(RotateCube, ByAQuarterTurn_MovesAFace) {
  std::vector<float> map(6 * 4, 0.0f);
  std::fill(map.begin(), map.begin() + 4, 1.0f);
  const std::vector<float> turned = rotateCube(map, 2, quarterTurn());
  for (std::size_t t = 0; t < 24; ++t) EXPECT_NEAR(turned[t], t >= 8 && t < 12 ? 1.0f : 0.0f, 1e-6f) << t;
}

TEST(Basis, WhatIsOutOfRange_IsRefused) {
  const std::vector<glm::dvec3> none{{0.0, 0.0, 0.0}};
  std::vector<float> values(23, 0.0f);
  const std::vector<double> eight(8, 0.0), broken(9, std::nan(""));
  EXPECT_THROW(basisValues(HarmonicBasis::Sh, none, 3), UsageError);
  EXPECT_THROW(basisValues(HarmonicBasis::Sh, {}, 33), UsageError);
  EXPECT_THROW(rotateHarmonics(HarmonicBasis::Sh, eight, 3, glm::dmat3(1.0)), UsageError);
  EXPECT_THROW(rotateHarmonics(HarmonicBasis::Sh, broken, 3, glm::dmat3(1.0)), UsageError);
  EXPECT_THROW(rotateHarmonics(HarmonicBasis::Sh, std::vector<double>(9, 0.0), 3, glm::dmat3(2.0)),
               UsageError);
  EXPECT_THROW(haarForward(values, 2), UsageError);
  EXPECT_THROW(haarForward(values, 3), UsageError);
  EXPECT_THROW(sphereRule(-1), UsageError);
  EXPECT_THROW(haarKept(values, 2.0), UsageError);
}

}  // namespace
}  // namespace prelight
