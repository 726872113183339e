#include "basis/sky_lobes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

namespace prelight {
namespace {

using std::numbers::pi;

double rowSolidAngle(int row, const Environment& sky) {
  return 2.0 * pi / sky.width * (std::cos(pi * row / sky.height) - std::cos(pi * (row + 1.0) / sky.height));
}

glm::dvec3 texelDirection(int column, int row, const Environment& sky) {
  return Environment::direction((column + 0.5) / sky.width, (row + 0.5) / sky.height);
}

/// Radiance 2 + w in direction w, a component per channel.
Environment slopedSky(int width) {
  Environment sky{width, width / 2, {}};
  for (int y = 0; y < sky.height; ++y)
    for (int x = 0; x < width; ++x) sky.radiance.emplace_back(2.0 + texelDirection(x, y, sky));
  return sky;
}

/// Dim noise with a lamp of 16 texels.
Environment lampedSky() {
  Environment sky{512, 256, {}};
  std::mt19937 random(3);
  std::uniform_real_distribution<float> dim(0.2f, 1.0f);
  for (int i = 0; i < sky.width * sky.height; ++i)
    sky.radiance.emplace_back(dim(random), dim(random), dim(random));
  for (int y = 80; y < 84; ++y)
    for (int x = 360; x < 364; ++x)
      sky.radiance[static_cast<std::size_t>(512 * y + x)] = {500.0f, 400.0f, 300.0f};
  return sky;
}

/// The mean over the lobe by its definition, with the half vector h of n and l: (n.h)^2 is (1 + n.l) / 2.
glm::dvec3 meanInLobe(const Environment& sky, const glm::dvec3& axis, double alpha) {
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (int y = 0; y < sky.height; ++y)
    for (int x = 0; x < sky.width; ++x) {
      const double cosine = glm::dot(axis, texelDirection(x, y, sky));
      if (cosine <= 0.0) continue;
      const double base = (alpha * alpha - 1.0) * (0.5 + 0.5 * cosine) + 1.0;
      const double weight = cosine * rowSolidAngle(y, sky) / (base * base);
      sum += weight * glm::dvec3(sky.radiance[static_cast<std::size_t>(y * sky.width + x)]);
      weights += weight;
    }
  return sum / weights;
}

TEST(SkyLobes, Spread_OfTheWidestLobe_IsThatOfTheCosine) {
  EXPECT_NEAR(lobeSpread(1.0), 1.0 / 3.0, 1e-9);
  EXPECT_EQ(lobeSpread(0.0), 0.0);
}

TEST(SkyLobes, AlphaOfSpread_IsItsInverse) {
  for (const double alpha : {0.02, 0.1, 0.35, 0.9})
    EXPECT_NEAR(alphaOfSpread(lobeSpread(alpha)), alpha, 1e-6);
}

TEST(SkyLobes, FirstBand_IsTheMeanCosine) {
  for (const double alpha : {0.05, 0.3, 1.0})
    EXPECT_NEAR(lobeFactors(alpha, 8)[1], 1.0 - lobeSpread(alpha), 1e-6) << alpha;
}

/// A lobe scales what grows with a component of the direction by its mean cosine.
TEST(SkyLobes, SlopedSky_IsFlattenedByTheMeanCosine) {
  const Environment sky = slopedSky(512);
  const SkyLobes lobes(sky);
  for (const double alpha : {0.05, 0.3, 1.0}) {
    const Environment map = lobes.map(alpha, 16);
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        const glm::dvec3 expected = 2.0 + (1.0 - lobeSpread(alpha)) * texelDirection(x, y, map);
        const glm::dvec3 found(map.radiance[static_cast<std::size_t>(y * map.width + x)]);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-3) << alpha;
      }
  }
}

TEST(SkyLobes, SkyWithALamp_IsTheIntegralOverTheLobe) {
  const Environment sky = lampedSky();
  const SkyLobes lobes(sky);
  for (const double alpha : {0.0358, 0.1, 0.4, 1.0}) {
    const Environment map = lobes.map(alpha, 64);
    for (const auto& [x, y] : {std::pair{45, 10}, {44, 11}, {47, 12}, {20, 16}, {1, 30}, {63, 0}}) {
      const glm::dvec3 expected = meanInLobe(sky, texelDirection(x, y, map), alpha);
      const glm::dvec3 found(map.radiance[static_cast<std::size_t>(y * map.width + x)]);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], expected[c], 0.01 * expected[c]) << alpha << " at " << x << ", " << y;
    }
  }
}

TEST(SkyLobes, Map_HasTheLightOfTheSky) {
  const Environment sky = lampedSky();
  const Environment map = SkyLobes(sky).map(0.1, 64);
  const auto mean = [](const Environment& of) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < of.height; ++y)
      for (int x = 0; x < of.width; ++x)
        sum += rowSolidAngle(y, of) * glm::dvec3(of.radiance[static_cast<std::size_t>(y * of.width + x)]);
    return sum;
  };
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean(map)[c], mean(sky)[c], 1e-2 * mean(sky)[c]);
}

}  // namespace
}  // namespace prelight
