#include "basis/sh_zonal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "basis/lights/sh_dominant_light.h"
#include "basis/lights/sh_lights.h"
#include "basis/quadrature.h"
#include "basis/sh_evaluate.h"
#include "basis/sh_projection.h"
#include "prelight/error.h"

namespace prelight {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> sun(int order) {
  std::vector<double> out(sh::coefficientCount(order));
  sh::capLight(glm::normalize(glm::dvec3(0.3, 0.8, -0.4)), 0.1, order, out);
  return out;
}

double gridMinimum(const std::vector<double>& f, int order) {
  double least = 1e300;
  for (const SphereSample& s : sphereQuadrature(200))
    least = std::min(least, sh::reconstruct(f, order, s.direction));
  return least;
}

TEST(ShWindows, HanningAndLanczos_HaveTheirValues) {
  const auto hanning = sh::window(sh::WindowKind::Hanning, 4);
  const auto lanczos = sh::window(sh::WindowKind::Lanczos, 4);
  EXPECT_NEAR(hanning[1], 0.5 + std::sqrt(0.125), 1e-15);
  EXPECT_NEAR(hanning[2], 0.5, 1e-15);
  EXPECT_NEAR(lanczos[2], 2.0 / std::numbers::pi, 1e-15);
  for (const double f : sh::window(sh::WindowKind::None, 4)) EXPECT_EQ(f, 1.0);
  EXPECT_EQ(hanning[0], 1.0);
  EXPECT_EQ(lanczos[0], 1.0);
}

TEST(ShWindows, Minimum_LinearBand_HasItsClosedForm) {
  const std::vector<double> f = {1.0, 0.3, -0.2, 0.6};
  const double expected = 0.5 / std::sqrt(std::numbers::pi) - std::sqrt(0.75 / std::numbers::pi) * 0.7;
  EXPECT_NEAR(sh::minimum(f, 2), expected, 1e-14);
}

TEST(ShWindows, Minimum_Sun_IsAtMostThatOfAFineGrid) {
  for (const int order : {3, 6, 14}) {
    const auto f = sun(order);
    EXPECT_LE(sh::minimum(f, order), gridMinimum(f, order)) << order;
    EXPECT_GT(sh::minimum(f, order), 1.01 * gridMinimum(f, order)) << order;
  }
}

TEST(ShWindows, MinimalWindow_Sun_IsJustNotNegative) {
  for (const int order : {3, 4, 6, 10}) {
    auto f = sun(order);
    ASSERT_LT(gridMinimum(f, order), 0.0);
    const double mean = f[0] * 0.28209479177387814;
    const sh::MinimalWindow window = sh::minimalWindow(f, order);
    auto weaker = f;
    sh::applyWindow(f, window.factors);
    EXPECT_GE(gridMinimum(f, order), -1e-9 * mean) << order;
    EXPECT_LT(gridMinimum(f, order), 1e-2 * mean) << order;
    std::vector<double> factors(order);
    for (int l = 0; l < order; ++l)
      factors[l] = 1.0 / (1.0 + 0.95 * window.lambda * l * l * (l + 1.0) * (l + 1.0));
    sh::applyWindow(weaker, factors);
    EXPECT_LT(sh::minimum(weaker, order), -1e-6 * mean) << "5 % less is not enough at order " << order;
  }
}

TEST(ShWindows, MinimalWindow_LinearBand_HasItsClosedForm) {
  // The factor f = 1 / (1 + 4 lambda) satisfies c0 Y0 = f sqrt(3 / 4 pi) |c1|.
  const std::vector<double> f = {1.0, 0.0, 1.2, 0.0};
  EXPECT_NEAR(sh::minimalWindow(f, 2).factors[1], 1.0 / (std::sqrt(3.0) * 1.2), 1e-6);
}

TEST(ShWindows, MinimalWindow_NothingNegative_ChangesNothing) {
  const std::vector<double> f = {1.0, 0.0, 0.2, 0.0};
  EXPECT_EQ(sh::minimalWindow(f, 2).lambda, 0.0);
  EXPECT_EQ(sh::minimalWindow(std::vector<double>(9, 0.0), 3).lambda, 0.0);
}

TEST(ShWindows, MinimalWindow_SeveralFunctions_TakesTheStrongest) {
  const std::vector<double> f = {1.0, 0.0, 0.2, 0.0, 1.0, 0.0, 1.2, 0.0};
  const std::vector<double> second(f.begin() + 4, f.end());
  EXPECT_EQ(sh::minimalWindow(f, 2).lambda, sh::minimalWindow(second, 2).lambda);
}

TEST(ShWindows, BadInput_IsAUsageError) {
  EXPECT_THROW(sh::window(sh::WindowKind::Hanning, 0), UsageError);
  EXPECT_THROW(sh::minimalWindow(std::vector<double>{1.0, 0.0, nan, 0.0}, 2), UsageError);
  EXPECT_THROW(sh::minimalWindow(std::vector<double>{-1.0, 0.0, 0.0, 0.0}, 2), UsageError);
  EXPECT_THROW(sh::minimalWindow(std::vector<double>{1.0, 0.0, 0.0}, 2), UsageError);
  EXPECT_THROW(sh::minimalWindow(std::vector<double>{}, 2), UsageError);
  EXPECT_THROW(sh::minimum(std::vector<double>(9, 1.0), 33), UsageError);
}

TEST(ShDominantLight, ASingleDirectionalLight_IsFoundWhole) {
  constexpr int order = 4;
  const glm::dvec3 towards = glm::normalize(glm::dvec3(0.3, 0.8, -0.4));
  std::vector<double> light(16);
  sh::directionalLight(towards, order, light);
  std::vector<double> radiance;
  for (const double scale : {2.0, 1.0, 0.5}) {
    for (const double v : light) radiance.push_back(scale * v);
  }
  const auto found = sh::dominantLight(radiance, order);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(glm::distance(found->towards, towards), 0.0, 1e-14);
  EXPECT_NEAR(found->irradiance.x, 2.0, 1e-14);
  EXPECT_NEAR(found->irradiance.z, 0.5, 1e-14);
  for (const double v : found->residual) EXPECT_NEAR(v, 0.0, 1e-14);
}

TEST(ShDominantLight, LightAndSky_LeaveAResidualAtRightAnglesToTheLight) {
  constexpr int order = 4;
  const glm::dvec3 towards = glm::normalize(glm::dvec3(0.3, 0.8, -0.4));
  std::vector<double> light(16);
  sh::directionalLight(towards, order, light);
  std::vector<double> radiance;
  for (int c = 0; c < 3; ++c) {
    for (const double v : light) radiance.push_back(v);
    radiance[16 * c] += 0.4;
    radiance[16 * c + 6] += 0.1;
  }
  const auto found = sh::dominantLight(radiance, order);
  ASSERT_TRUE(found.has_value());
  for (int c = 0; c < 3; ++c) {
    double product = 0.0;
    for (int i = 0; i < 16; ++i) product += found->residual[16 * c + i] * light[i];
    EXPECT_NEAR(product, 0.0, 1e-13);
  }
}

TEST(ShDominantLight, ConstantSky_HasNone) {
  std::vector<double> radiance(27, 0.0);
  for (int c = 0; c < 3; ++c) radiance[9 * c] = 1.0;
  EXPECT_FALSE(sh::dominantLight(radiance, 3).has_value());
  EXPECT_THROW(sh::dominantLight(radiance, 1), UsageError);
  EXPECT_THROW(sh::dominantLight(radiance, 2), UsageError);
  radiance[3] = nan;
  EXPECT_THROW(sh::dominantLight(radiance, 3), UsageError);
}

/// Radiance coefficients [channel][i] of directional lights.
std::vector<double> radianceOf(const std::vector<sh::DominantLights::Light>& lights, int order) {
  const auto count = static_cast<std::size_t>(order * order);
  std::vector<double> radiance(3 * count, 0.0), values(count);
  for (const auto& light : lights) {
    sh::directionalLight(light.towards, order, values);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < count; ++i)
        radiance[c * count + i] += light.irradiance[static_cast<int>(c)] * values[i];
  }
  return radiance;
}

// Three lights that are further apart than the peaks of order 5 are wide keep their own peaks in the
// coefficients.
TEST(ShDominantLights, ThreeDirectionalLights_AreFoundWhole_FromTheBrightestOn) {
  constexpr int order = 5;
  const std::vector<sh::DominantLights::Light> lights = {
      {glm::normalize(glm::dvec3(0.3, 0.8, -0.4)), {3.0, 2.0, 1.0}},
      {glm::normalize(glm::dvec3(-0.9, 0.1, 0.3)), {0.5, 1.0, 2.0}},
      {glm::normalize(glm::dvec3(0.4, -0.2, 0.9)), {0.6, 0.1, 0.2}}};
  const auto found = sh::dominantLights(radianceOf(lights, order), order, 3);
  ASSERT_EQ(found.lights.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(glm::distance(found.lights[k].towards, lights[k].towards), 1e-4) << k;
    EXPECT_LT(glm::distance(found.lights[k].irradiance, lights[k].irradiance), 1e-3) << k;
  }
  for (const double v : found.residual) EXPECT_NEAR(v, 0.0, 1e-3);
}

TEST(ShDominantLights, OneMore_NeverLeavesMore_AndTheResidualIsAtRightAnglesToEach) {
  constexpr int order = 4;
  std::vector<sh::DominantLights::Light> lights;
  for (int i = 0; i < 9; ++i)
    lights.push_back(
        {glm::normalize(glm::dvec3(std::sin(2.0 * i), std::cos(3.0 * i), std::sin(5.0 * i + 1.0))),
         glm::dvec3(1.0 + 0.3 * i)});
  std::vector<double> radiance = radianceOf(lights, order);
  for (int c = 0; c < 3; ++c) radiance[16 * c] += 2.0;
  double before = 1e30;
  for (std::size_t most = 1; most <= 4; ++most) {
    const auto found = sh::dominantLights(radiance, order, most);
    double square = 0.0;
    for (const double v : found.residual) square += v * v;
    EXPECT_LT(square, before) << most;
    before = square;
    for (const auto& light : found.lights) {
      if (light.irradiance.x == 0.0) continue;
      std::vector<double> values(16);
      sh::directionalLight(light.towards, order, values);
      double product = 0.0;
      for (int i = 0; i < 16; ++i) product += found.residual[i] * values[i];
      EXPECT_NEAR(product, 0.0, 1e-9);
    }
  }
}

TEST(ShDominantLights, OfDarkness_AreNone_AndOfOneLightJustThat) {
  EXPECT_TRUE(sh::dominantLights(std::vector<double>(27, 0.0), 3, 3).lights.empty());
  const auto found =
      sh::dominantLights(radianceOf({{glm::normalize(glm::dvec3(1.0, 2.0, 3.0)), {1.0, 1.0, 1.0}}}, 3), 3, 3);
  ASSERT_FALSE(found.lights.empty());
  EXPECT_NEAR(found.lights[0].irradiance.y, 1.0, 1e-6);
  EXPECT_THROW(sh::dominantLights(std::vector<double>(3, 0.0), 1, 1), UsageError);
}

TEST(ShProjection, Polynomial_IsExactAtItsDegree) {
  // x y z lies in band 3 alone: its coefficient is the integral of x^2 y^2 z^2, 4 pi / 105, times Y's factor.
  const auto f = sh::project([](const glm::dvec3& w) { return w.x * w.y * w.z; }, 3, 6);
  double square = 0.0;
  for (const double v : f) square += v * v;
  EXPECT_NEAR(square, 4.0 * std::numbers::pi / 105.0, 1e-15);
  EXPECT_NEAR(f[3 * 4 - 2] * f[3 * 4 - 2], square, 1e-15);
}

TEST(ShProjection, SmoothFunction_ReachesItsTolerance) {
  const auto f = [](const glm::dvec3& w) { return std::exp(3.0 * w.z); };
  const sh::Projection found = sh::projectWithin(f, 1e-10, 8);
  EXPECT_LE(found.error, 1e-10);
  // The integral of exp(3 z) is 4 pi sinh(3) / 3.
  EXPECT_NEAR(found.coefficients[0], 4.0 * std::numbers::pi * std::sinh(3.0) / 3.0 * 0.28209479177387814,
              1e-9);
}

TEST(ShProjection, Cap_ErrorIsReportedAndHolds) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, 3));
  const auto f = [&](const glm::dvec3& w) { return glm::dot(w, axis) > std::cos(0.4) ? 1.0 : 0.0; };
  const sh::Projection found = sh::projectWithin(f, 1e-9, 6, 400);
  EXPECT_GT(found.error, 1e-9) << "a jump cannot converge so far";
  std::vector<double> exact(36);
  sh::capLight(axis, 0.4, 6, exact);
  for (int i = 0; i < 36; ++i) EXPECT_NEAR(found.coefficients[i], exact[i], 3.0 * found.error);
}

TEST(ShProjection, BadInput_IsAnError) {
  const auto one = [](const glm::dvec3&) { return 1.0; };
  EXPECT_THROW(sh::project(one, 3, 0), UsageError);
  EXPECT_THROW(sh::project(one, 3, 33), UsageError);
  EXPECT_THROW(sh::project(one, -1, 3), UsageError);
  EXPECT_THROW(sh::projectWithin(one, 0.0, 3), UsageError);
  EXPECT_THROW(sh::project([](const glm::dvec3&) { return nan; }, 3, 3), Error);
}

}  // namespace
}  // namespace prelight
