// The sun and the lamps that a sky's map contains.
#include "images/sky_lamps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "images/preetham_sky.h"
#include "support/disk_skies.h"

namespace prelight {
namespace {

using std::numbers::pi;
constexpr double oneDegree = pi / 180.0;

glm::dvec3 fluxOf(const Environment& sky) {
  glm::dvec3 sum(0.0);
  for (int row = 0; row < sky.height; ++row)
    for (int column = 0; column < sky.width; ++column)
      sum += glm::dvec3(sky.radiance[static_cast<std::size_t>(row) * sky.width + column]) * 2.0 * pi /
             double(sky.width) * (std::cos(pi * row / sky.height) - std::cos(pi * (row + 1) / sky.height));
  return sum;
}

DaySky dayOf(double elevation, bool sun) {
  DaySky day;
  day.elevation = elevation;
  day.azimuth = 70.0 * oneDegree;
  day.sun = sun;
  return day;
}

TEST(SkyLamps, DayWithItsDisk_HasThatSun) {
  for (const double elevation : {8.0 * oneDegree, 40.0 * oneDegree, 80.0 * oneDegree}) {
    const std::vector<SkyLamp> lamps = takeLampsOut(daySky(dayOf(elevation, true))).lamps;
    ASSERT_FALSE(lamps.empty()) << elevation;
    const glm::dvec3 towards(std::cos(elevation) * std::sin(70.0 * oneDegree), std::sin(elevation),
                             -std::cos(elevation) * std::cos(70.0 * oneDegree));
    EXPECT_GT(glm::dot(lamps[0].direction, towards), std::cos(0.2 * oneDegree)) << elevation;
    EXPECT_LT(lamps[0].radius, 0.5 * oneDegree) << elevation;
    const glm::dvec3 expected = sunIrradiance(3.0, elevation);
    for (int c = 0; c < 3; ++c)  // It also takes a little of the sky near it.
      EXPECT_NEAR(lamps[0].irradiance[c], expected[c], 0.02 * expected[c]) << elevation << " " << c;
  }
}

TEST(SkyLamps, LampsAndRest_AddUpToTheSky) {
  const Environment sky = daySky(dayOf(30.0 * oneDegree, true));
  const LampsAndSky parts = takeLampsOut(sky);
  ASSERT_FALSE(parts.lamps.empty());
  glm::dvec3 sum = fluxOf(parts.rest);
  for (const SkyLamp& lamp : parts.lamps) sum += lamp.irradiance;
  const glm::dvec3 whole = fluxOf(sky);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], whole[c], 1e-3 * whole[c]) << c;
}

/// A dark sky with disks of radiance 100 around directions.
Environment skyWithDisks(std::span<const glm::dvec3> directions, double radius) {
  Environment sky{512, 256, std::vector<glm::vec3>(512 * 256, glm::vec3(0.1f))};
  for (const glm::dvec3& direction : directions) test::addDisk(sky, direction, radius, glm::vec3(100.0f));
  return sky;
}

/// Irradiance by the radiance beyond 0.1 within an angle, on a surface that faces its middle.
double irradianceAround(const Environment& sky, const glm::dvec3& direction, double angle) {
  double sum = 0.0;
  for (int row = 0; row < sky.height; ++row)
    for (int column = 0; column < sky.width; ++column) {
      const glm::dvec3 w = Environment::direction((column + 0.5) / sky.width, (row + 0.5) / sky.height);
      const double cosine = glm::dot(w, direction);
      if (cosine > std::cos(angle))
        sum += (sky.radiance[row * sky.width + column].y - 0.1) * cosine * 2.0 * pi / sky.width *
               (std::cos(pi * row / sky.height) - std::cos(pi * (row + 1) / sky.height));
    }
  return sum;
}

TEST(SkyLamps, DisksOfAStudio_AreFoundWithTheirSizes) {
  const std::array directions = {glm::normalize(glm::dvec3(1, 0.2, 0)), glm::normalize(glm::dvec3(-1, 1, 2)),
                                 glm::normalize(glm::dvec3(-1, 0.5, -2))};
  for (const double radius : {2.0 * oneDegree, 4.0 * oneDegree, 8.0 * oneDegree}) {
    const Environment sky = skyWithDisks(directions, radius);
    const LampsAndSky parts = takeLampsOut(sky);
    ASSERT_EQ(parts.lamps.size(), 3u) << radius;
    for (const glm::dvec3& direction : directions) {
      const auto lamp = std::ranges::max_element(
          parts.lamps, {}, [&](const SkyLamp& l) { return glm::dot(l.direction, direction); });
      EXPECT_GT(glm::dot(lamp->direction, direction), std::cos(0.3 * oneDegree));
      EXPECT_NEAR(lamp->radius, radius, 0.1 * radius + 0.2 * oneDegree);
      const double expected = irradianceAround(sky, direction, 1.2 * radius);
      EXPECT_NEAR(lamp->irradiance.y, expected, 0.01 * expected);
    }
    for (const glm::vec3& radiance : parts.rest.radiance) EXPECT_LE(radiance.y, 0.1f + 1e-4f);
  }
}

TEST(SkyLamps, TwoDisksNearEachOther_AreTwoLamps) {
  const double apart = 14.0 * oneDegree;
  const std::array directions = {glm::dvec3(1, 0, 0), glm::dvec3(std::cos(apart), std::sin(apart), 0)};
  EXPECT_EQ(takeLampsOut(skyWithDisks(directions, 2.0 * oneDegree)).lamps.size(), 2u);
}

/// A panel is brighter than the disk elsewhere, and its middle is no lamp.
TEST(SkyLamps, DiskDimmerThanAPanel_IsFound) {
  const glm::dvec3 direction(0, 0, 1);
  for (const double side : {40.0 * oneDegree, 50.0 * oneDegree, 60.0 * oneDegree}) {
    Environment sky = skyWithDisks(std::array{direction}, 8.0 * oneDegree);
    for (int row = 0; row < 256; ++row)
      for (int column = 0; column < 512; ++column) {
        const glm::dvec3 w = Environment::direction((column + 0.5) / 512, (row + 0.5) / 256);
        if (w.z < 0.0 && std::max(std::abs(std::atan(w.x / w.z)), std::abs(std::atan(w.y / w.z))) < side / 2)
          sky.radiance[static_cast<std::size_t>(row) * 512 + column] = glm::vec3(110.0f);
      }
    const std::vector<SkyLamp> lamps = takeLampsOut(sky).lamps;
    EXPECT_TRUE(std::ranges::any_of(lamps, [&](const SkyLamp& lamp) {
      return glm::dot(lamp.direction, direction) > std::cos(0.3 * oneDegree);
    })) << side;
  }
}

TEST(SkyLamps, SkiesWithoutSmallLights_StayWhole) {
  const auto lampsOf = [](const Environment& sky) { return takeLampsOut(sky).lamps.size(); };
  EXPECT_EQ(lampsOf(daySky(dayOf(40.0 * oneDegree, false))), 0u);
  EXPECT_EQ(lampsOf(studioEnvironment()), 0u) << "its lights are large";
  EXPECT_EQ(lampsOf(constantEnvironment(glm::vec3(2.0f))), 0u);
  EXPECT_EQ(lampsOf(constantEnvironment(glm::vec3(0.0f))), 0u);
  const std::array up = {glm::dvec3(0, 1, 0)};
  EXPECT_EQ(lampsOf(skyWithDisks(up, 20.0 * oneDegree)), 0u);
}

TEST(SkyLamps, SkyOfManyTexels_HasTheLampsOfItsMeans) {
  const std::array directions = {glm::normalize(glm::dvec3(1, 0.2, 0)),
                                 glm::normalize(glm::dvec3(0, 1, 0.1))};
  const Environment sky = skyWithDisks(directions, 4.0 * oneDegree);
  Environment fine{4 * sky.width, 4 * sky.height, {}};
  for (int row = 0; row < fine.height; ++row)
    for (int column = 0; column < fine.width; ++column)
      fine.radiance.push_back(sky.radiance[static_cast<std::size_t>(row / 4) * sky.width + column / 4]);
  const LampsAndSky parts = takeLampsOut(fine);
  EXPECT_EQ(parts.rest.width, 1024);
  ASSERT_EQ(parts.lamps.size(), 2u);
  for (const glm::dvec3& direction : directions)
    EXPECT_TRUE(std::ranges::any_of(parts.lamps, [&](const SkyLamp& lamp) {
      return glm::dot(lamp.direction, direction) > std::cos(0.3 * oneDegree);
    }));
}

TEST(SkyLamps, BrightTexelOfACoarseMap_IsNoLamp) {
  Environment sky{8, 4, std::vector<glm::vec3>(32, glm::vec3(0.1f))};
  sky.radiance[9] = glm::vec3(100.0f);
  EXPECT_TRUE(takeLampsOut(sky).lamps.empty());
}

}  // namespace
}  // namespace prelight
