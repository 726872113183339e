#include "basis/median_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prelight {
namespace {

using std::numbers::pi;

Environment sky(int width, int height, const glm::vec3& radiance) {
  return {width, height, std::vector<glm::vec3>(static_cast<std::size_t>(width * height), radiance)};
}

glm::dvec3 sumOf(const std::vector<SkyLight>& lights) {
  glm::dvec3 sum(0.0);
  for (const SkyLight& light : lights) sum += light.irradiance;
  return sum;
}

TEST(MedianCut, EvenSky_IsKeptInAll) {
  for (const int count : {1, 2, 32, 100}) {
    const auto lights = medianCut(sky(128, 64, {1, 2, 3}), count);
    EXPECT_EQ(lights.size(), static_cast<std::size_t>(count));
    EXPECT_NEAR(sumOf(lights).y, 8.0 * pi, 1e-5);
    for (const SkyLight& light : lights) EXPECT_NEAR(glm::length(light.direction), 1.0, 1e-12);
  }
}

// With many lights the irradiance of a surface is nearly that of the sky, pi.
TEST(MedianCut, EvenSky_LightsEverySideAlike) {
  const auto lights = medianCut(sky(256, 128, glm::vec3(1.0f)), 256);
  for (const glm::dvec3& n : {glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0.6, -0.8, 0)}) {
    double irradiance = 0.0;
    for (const SkyLight& light : lights)
      irradiance += std::max(0.0, glm::dot(n, light.direction)) * light.irradiance.x;
    EXPECT_NEAR(irradiance, pi, 0.05);
  }
}

TEST(MedianCut, SmallMap_IsStillCut) { EXPECT_EQ(medianCut(sky(1, 1, glm::vec3(1.0f)), 32).size(), 32u); }

TEST(MedianCut, Sun_GetsItsPlaceAndItsEnergy) {
  Environment map = sky(256, 128, glm::vec3(0.001f));
  const int column = 40, row = 30;
  map.radiance[row * 256 + column] = glm::vec3(1e5f);
  const auto lights = medianCut(map, 8);
  const glm::dvec3 sun = Environment::direction((column + 0.5) / 256, (row + 0.5) / 128);
  double best = 0.0, energy = 0.0;
  for (const SkyLight& light : lights)
    if (light.irradiance.x > energy) {
      energy = light.irradiance.x;
      best = glm::dot(light.direction, sun);
    }
  EXPECT_GT(best, 0.9999);
  EXPECT_GT(energy, 0.99 * sumOf(lights).x);
}

TEST(MedianCut, BlackSky_HasNoLights) { EXPECT_TRUE(medianCut(sky(64, 32, glm::vec3(0.0f)), 32).empty()); }

TEST(MedianCut, OneBrightTexel_CannotBeCut) {
  Environment map = sky(128, 64, glm::vec3(0.0f));
  map.radiance[5000] = glm::vec3(1.0f);
  const auto lights = medianCut(map, 32);
  EXPECT_GE(lights.size(), 1u);
  EXPECT_LE(lights.size(), 32u);
  EXPECT_GT(sumOf(lights).x, 0.0);
}

}  // namespace
}  // namespace prelight
