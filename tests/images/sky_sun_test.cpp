// The sun that a sky's map contains.
#include "images/sky_sun.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "images/preetham_sky.h"

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

TEST(SkySun, DayWithItsDisk_HasThatSun) {
  for (const double elevation : {8.0 * oneDegree, 40.0 * oneDegree, 80.0 * oneDegree}) {
    const std::optional<SunAndSky> parts = takeSunOut(daySky(dayOf(elevation, true)));
    ASSERT_TRUE(parts) << elevation;
    const glm::dvec3 towards(std::cos(elevation) * std::sin(70.0 * oneDegree), std::sin(elevation),
                             -std::cos(elevation) * std::cos(70.0 * oneDegree));
    EXPECT_GT(glm::dot(parts->sun.direction, towards), std::cos(0.2 * oneDegree)) << elevation;
    EXPECT_LT(parts->sun.radius, 0.5 * oneDegree) << elevation;
    const glm::dvec3 expected = sunIrradiance(3.0, elevation);
    for (int c = 0; c < 3; ++c)  // It also takes a little of the sky near it.
      EXPECT_NEAR(parts->sun.irradiance[c], expected[c], 0.02 * expected[c]) << elevation << " " << c;
  }
}

TEST(SkySun, SunAndRest_AddUpToTheSky) {
  const Environment sky = daySky(dayOf(30.0 * oneDegree, true));
  const std::optional<SunAndSky> parts = takeSunOut(sky);
  ASSERT_TRUE(parts);
  const glm::dvec3 whole = fluxOf(sky), rest = fluxOf(parts->rest);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(rest[c] + parts->sun.irradiance[c], whole[c], 1e-4 * whole[c]) << c;
}

TEST(SkySun, SkiesWithoutOne_StayWhole) {
  EXPECT_FALSE(takeSunOut(daySky(dayOf(40.0 * oneDegree, false))));
  EXPECT_FALSE(takeSunOut(studioEnvironment())) << "its lights are large";
  EXPECT_FALSE(takeSunOut(constantEnvironment(glm::vec3(2.0f))));
  EXPECT_FALSE(takeSunOut(constantEnvironment(glm::vec3(0.0f))));
}

/// A single bright texel of a coarse map is no sun.
TEST(SkySun, BrightTexelOfACoarseMap_IsNoSun) {
  Environment sky{8, 4, std::vector<glm::vec3>(32, glm::vec3(0.1f))};
  sky.radiance[9] = glm::vec3(100.0f);
  EXPECT_FALSE(takeSunOut(sky));
}

}  // namespace
}  // namespace prelight
