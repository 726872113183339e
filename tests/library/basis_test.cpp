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

/// Returns the value of a function in SH in a direction.
double valueOf(const std::vector<double>& sh, int order, const glm::dvec3& direction) {
  const std::vector<double> y = basisValues(HarmonicBasis::Sh, std::vector<glm::dvec3>{direction}, order);
  double sum = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) sum += sh[i] * y[i];
  return sum;
}

std::vector<double> waves(std::size_t count, double phase) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = std::sin(phase + static_cast<double>(i));
  return values;
}

/// The product of functions of 3 and 2 bands has 4 bands, in which it is the product of their values.
TEST(MultiplySh, TwoFunctions_GiveTheProductOfTheirValues) {
  const std::vector<double> f = waves(9, 1.0), g = waves(4, 2.0), product = multiplySh(f, 3, g, 2, 4);
  for (const glm::dvec3& w :
       {glm::dvec3(0.6, 0.0, 0.8), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(-0.48, 0.6, 0.64)})
    EXPECT_NEAR(valueOf(product, 4, w), valueOf(f, 3, w) * valueOf(g, 2, w), 1e-12);
}

/// By the matrix, by the triple products and directly, a product is the same.
TEST(ProductMatrix, TimesAFunction_IsTheirProduct) {
  const std::vector<double> f = waves(16, 1.0), g = waves(9, 2.0), right = multiplySh(f, 4, g, 3, 3);
  const std::vector<double> matrix = productMatrix(f, 4, 3);
  std::vector<double> byTriples(9, 0.0);
  for (const TripleProduct& t : tripleProducts(3, 4)) {
    byTriples[t.i] += t.value * f[t.k] * g[t.j];
    if (t.i != t.j) byTriples[t.j] += t.value * f[t.k] * g[t.i];
  }
  for (std::size_t i = 0; i < 9; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < 9; ++j) sum += matrix[9 * i + j] * g[j];
    EXPECT_NEAR(sum, right[i], 1e-12);
    EXPECT_NEAR(byTriples[i], right[i], 1e-12);
  }
}

/// Returns integral f(cos) Y_l0 dw by a midpoint rule in the cosine.
template <typename Function>
double zonalIntegral(const Function& f, int l) {
  constexpr int steps = 200000;
  double sum = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double z = -1.0 + 2.0 * (k + 0.5) / steps;
    sum += f(z) * std::legendre(static_cast<unsigned>(l), z);
  }
  return sum * 2.0 / steps * 2.0 * pi * std::sqrt((2.0 * l + 1.0) / (4.0 * pi));
}

TEST(ZonalFunctions, Coefficients_AreTheirIntegrals) {
  const std::vector<double> cosine = zonalClampedCosine(5), cap = zonalCap(0.7, 5),
                            lobe = zonalCosinePower(6.0, 5);
  for (int l = 0; l < 5; ++l) {
    const auto i = static_cast<std::size_t>(l);
    EXPECT_NEAR(cosine[i], zonalIntegral([](double z) { return std::max(z, 0.0) / pi; }, l), 1e-8) << l;
    EXPECT_NEAR(cap[i], zonalIntegral([](double z) { return z > std::cos(0.7) ? 1.0 : 0.0; }, l), 1e-4) << l;
    EXPECT_NEAR(lobe[i],
                zonalIntegral([](double z) { return 7.0 / (2.0 * pi) * std::pow(std::max(z, 0.0), 6.0); }, l),
                1e-8)
        << l;
  }
}

/// About its axis, which may have any length, a turned function has the values that it had about z.
TEST(TurnZonal, AboutAnyAxis_KeepsItsValues) {
  const std::vector<double> zonal = zonalCosinePower(3.0, 4);
  const std::vector<double> about = rotateZonal(zonal, {0.0, 0.0, 1.0}),
                            turned = rotateZonal(zonal, {0.0, 3.0, 4.0});
  EXPECT_NEAR(valueOf(turned, 4, {0.0, 0.6, 0.8}), valueOf(about, 4, {0.0, 0.0, 1.0}), 1e-12);
  EXPECT_NEAR(valueOf(turned, 4, {1.0, 0.0, 0.0}), valueOf(about, 4, {1.0, 0.0, 0.0}), 1e-12);
}

/// Under L = 1 + cos(theta) about +Z, a surface that faces +Z has the irradiance pi + 2 pi / 3.
TEST(ConvolveSh, RadianceWithTheClampedCosine_IsIrradianceOverPi) {
  std::vector<double> radiance(9, 0.0);
  radiance[0] = std::sqrt(4.0 * pi);
  radiance[2] = std::sqrt(4.0 * pi / 3.0);
  const std::vector<double> lit = convolveSh(radiance, zonalClampedCosine(3));
  EXPECT_NEAR(pi * valueOf(lit, 3, {0.0, 0.0, 1.0}), pi + 2.0 * pi / 3.0, 1e-12);
}

TEST(Basis, ProductsAndZonalFunctionsOutOfRange_AreRefused) {
  const std::vector<double> nine(9, 1.0), none;
  EXPECT_THROW(multiplySh(nine, 4, nine, 3, 3), UsageError);
  EXPECT_THROW(productMatrix(nine, 3, 0), UsageError);
  EXPECT_THROW(zonalCap(-0.1, 3), UsageError);
  EXPECT_THROW(zonalCap(0.1, 33), UsageError);
  EXPECT_THROW(zonalCosinePower(-1.0, 3), UsageError);
  EXPECT_THROW(rotateZonal(none, {0.0, 0.0, 1.0}), UsageError);
  EXPECT_THROW(rotateZonal(nine, {0.0, 0.0, 0.0}), UsageError);
  EXPECT_THROW(convolveSh(nine, std::vector<double>(2, 1.0)), UsageError);
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
