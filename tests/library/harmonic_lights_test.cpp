#include "prelight/harmonic_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "prelight/prelight.h"

namespace prelight {
namespace {

using std::numbers::pi;

constexpr int lightOrder = 4;

/// Returns the SH coefficients of a function of directions by a rule of many directions.
std::vector<double> integrated(const std::function<double(const glm::dvec3&)>& f) {
  static const SphereRule rule = sphereRule(900);
  static const std::vector<double> y = basisValues(HarmonicBasis::Sh, rule.directions, lightOrder);
  std::vector<double> sums(lightOrder * lightOrder, 0.0);
  for (std::size_t k = 0; k < rule.weights.size(); ++k) {
    const double value = rule.weights[k] * f(rule.directions[k]);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += value * y[k * sums.size() + i];
  }
  return sums;
}

/// The rule blurs outlines by about the distance between its directions.
void expectLight(const std::vector<double>& got, const std::function<double(const glm::dvec3&)>& f) {
  const std::vector<double> right = integrated(f);
  ASSERT_EQ(got.size(), right.size());
  for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(got[i], right[i], 4e-3) << i;
}

TEST(LightsInSh, OfEveryShape_AreIntegralsOverWhatIsSeen) {
  const glm::dvec3 axis(0.0, 0.6, 0.8);
  expectLight(shOfCap(5.0 * axis, 0.5, lightOrder),
              [&](const glm::dvec3& w) { return glm::dot(w, axis) > std::cos(0.5) ? 1.0 : 0.0; });
  expectLight(shOfSphere(4.0 * axis, 2.0, lightOrder),
              [&](const glm::dvec3& w) { return glm::dot(w, axis) > std::cos(pi / 6.0) ? 1.0 : 0.0; });
  expectLight(shOfDisk({0.0, 0.0, 2.0}, {0.0, 0.0, -7.0}, 1.5, lightOrder), [](const glm::dvec3& w) {
    return w.z > 0.0 && std::hypot(w.x, w.y) * 2.0 / w.z < 1.5 ? 1.0 : 0.0;
  });
  const std::vector<glm::dvec3> square{
      {1.0, -1.0, 2.0}, {1.0, 1.0, 2.0}, {-1.0, 1.0, 2.0}, {-1.0, -1.0, 2.0}};
  expectLight(shOfPolygon(square, lightOrder), [](const glm::dvec3& w) {
    return w.z > 0.0 && 2.0 * std::max(std::abs(w.x), std::abs(w.y)) < w.z ? 1.0 : 0.0;
  });
}

/// A small sphere of radiance 1 is a point light of intensity pi r^2.
TEST(LightsInSh, OfASmallSphere_IsThatOfAPoint) {
  const glm::dvec3 centre(1.0, 2.0, 2.0);
  const std::vector<double> sphere = shOfSphere(centre, 1e-3, lightOrder),
                            point = shOfPoint(centre, lightOrder),
                            direction = shOfDirection(centre, lightOrder);
  for (std::size_t i = 0; i < point.size(); ++i) {
    EXPECT_NEAR(sphere[i], pi * 1e-6 * point[i], 1e-12);
    EXPECT_NEAR(point[i], direction[i] / 9.0, 1e-14);
  }
}

TEST(DominantLights, OfTwoSuns_AreFoundFromTheBrighterOn) {
  const glm::dvec3 high(0.0, 1.0, 0.0), low(0.8, 0.6, 0.0);
  const std::vector<double> one = shOfDirection(high, 8), two = shOfDirection({-0.8, -0.6, 0.0}, 8);
  std::vector<double> radiance;
  for (const double channel : {1.0, 2.0, 3.0})
    for (std::size_t i = 0; i < one.size(); ++i) radiance.push_back(channel * (5.0 * one[i] + two[i]));
  const DominantLights found = dominantLights(radiance, 8, 2);
  ASSERT_EQ(found.lights.size(), 2u);
  EXPECT_NEAR(glm::dot(found.lights[0].towards, high), 1.0, 1e-6);
  EXPECT_NEAR(glm::dot(found.lights[1].towards, -low), 1.0, 1e-6);
  EXPECT_NEAR(found.lights[0].irradiance.z, 15.0, 1e-3);
  EXPECT_NEAR(found.lights[1].irradiance.x, 1.0, 1e-3);
  for (const double left : found.residual) EXPECT_NEAR(left, 0.0, 1e-3);
}

TEST(LightsInSh, WhatMakesNoSense_IsRefused) {
  EXPECT_THROW(shOfDirection({0.0, 0.0, 0.0}, 3), UsageError);
  EXPECT_THROW(shOfDirection({0.0, 0.0, 1.0}, 0), UsageError);
  EXPECT_THROW(shOfPoint({0.0, 0.0, 0.0}, 3), UsageError);
  EXPECT_THROW(shOfCap({0.0, 0.0, 1.0}, 4.0, 3), UsageError);
  EXPECT_THROW(shOfSphere({0.0, 0.0, 1.0}, -1.0, 3), UsageError);
  EXPECT_THROW(shOfDisk({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}, 1.0, 3), UsageError);
  EXPECT_THROW(shOfPolygon(std::vector<glm::dvec3>{{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}}, 3), UsageError);
  EXPECT_THROW(dominantLights(std::vector<double>(3), 1), UsageError);
  EXPECT_THROW(dominantLights(std::vector<double>(27, 1.0), 3, 0), UsageError);
  EXPECT_THROW(dominantLights(std::vector<double>(26, 1.0), 3), UsageError);
}

}  // namespace
}  // namespace prelight
