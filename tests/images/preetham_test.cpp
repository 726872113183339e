// The built-in day without clouds.
#include "images/preetham_sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prelight/error.h"

namespace prelight {
namespace {

using std::numbers::pi;

double luminanceOf(const glm::vec3& rgb) {
  return glm::dot(glm::dvec3(rgb), glm::dvec3(0.2126, 0.7152, 0.0722));
}

glm::vec3 radianceAt(const Environment& sky, const glm::dvec3& direction) {
  const glm::dvec2 at = Environment::coordinates(glm::normalize(direction));
  const int column = std::min(static_cast<int>(at.x * sky.width), sky.width - 1);
  const int row = std::min(static_cast<int>(at.y * sky.height), sky.height - 1);
  return sky.radiance[static_cast<std::size_t>(row) * sky.width + column];
}

/// Illuminance of level ground, in units of the map times steradians.
double illuminanceOf(const Environment& sky) {
  double sum = 0.0;
  for (int row = 0; row < sky.height / 2; ++row) {
    const double polar = pi * (row + 0.5) / sky.height;
    for (int column = 0; column < sky.width; ++column)
      sum += luminanceOf(sky.radiance[static_cast<std::size_t>(row) * sky.width + column]) * std::sin(polar) *
             std::cos(polar) * 2.0 * pi * pi / (double(sky.width) * sky.height);
  }
  return sum;
}

constexpr double degree = pi / 180.0;

// The paper has a separate formula for the zenith's luminance (A.2), here for turbidity 3 and the sun at 50
// degrees from the zenith.
TEST(PreethamSky, Zenith_HasThePapersLuminance) {
  const Environment sky = daySky({3.0, 40.0 * degree, 1.0, 0.2});
  const double chi = (4.0 / 9.0 - 3.0 / 120.0) * (pi - 2.0 * 50.0 * degree);
  const double expected = (4.0453 * 3.0 - 4.9710) * std::tan(chi) - 0.2155 * 3.0 + 2.4192;
  EXPECT_NEAR(luminanceOf(radianceAt(sky, {0, 1, 0})) / expected, 1.0, 0.02);
}

// At such elevations a clear sky without the sun gives level ground ten thousand lux or more, and less than
// the sun sends to the top of the air: 134 thousand lux times the sine of its elevation.
TEST(PreethamSky, Ground_GetsTheLightOfADayAndNoMoreThanTheSunSends) {
  for (const double turbidity : {2.5, 4.0}) {
    const double thousandLux = illuminanceOf(daySky({turbidity, 45.0 * degree, 0.0, 0.2}));
    EXPECT_GT(thousandLux, 8.0) << turbidity;
    EXPECT_LT(thousandLux, 134.0 * std::sin(45.0 * degree)) << turbidity;
  }
}

TEST(PreethamSky, Sun_BrightensItsSide_AndStandsWhereItWasAskedFor) {
  for (const double azimuth : {0.0, 90.0, 200.0}) {
    const double a = azimuth * degree, e = 30.0 * degree;
    const Environment sky = daySky({3.0, e, a, 0.2});
    const glm::dvec3 towards(std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e));
    const glm::dvec3 away(-towards.x, towards.y, -towards.z);
    EXPECT_GT(luminanceOf(radianceAt(sky, towards)), 4.0 * luminanceOf(radianceAt(sky, away)));
    const auto brightest = std::max_element(
        sky.radiance.begin(), sky.radiance.end(),
        [](const glm::vec3& x, const glm::vec3& y) { return luminanceOf(x) < luminanceOf(y); });
    const auto index = static_cast<int>(brightest - sky.radiance.begin());
    const glm::dvec3 found =
        Environment::direction((index % sky.width + 0.5) / sky.width, (index / sky.width + 0.5) / sky.height);
    EXPECT_GT(glm::dot(found, towards), std::cos(15.0 * degree)) << azimuth;
  }
}

TEST(PreethamSky, ClearAir_IsBluerThanHaze_AndEveryTexelIsRadiance) {
  const auto blueness = [](const Environment& sky) {
    const glm::vec3 up = radianceAt(sky, {0, 1, 0});
    return up.b / up.r;
  };
  EXPECT_GT(blueness(daySky({2.5, 0.8, 0.0, 0.2})), 1.2 * blueness(daySky({8.0, 0.8, 0.0, 0.2})));
  for (const double turbidity : {2.0, 5.0, 10.0})
    for (const double elevation : {0.0, 10.0, 45.0, 90.0})
      for (const glm::vec3& texel : daySky({turbidity, elevation * degree, 0.0, 0.2}).radiance)
        for (int c = 0; c < 3; ++c) ASSERT_TRUE(texel[c] >= 0.0f && texel[c] < 1e3f) << texel[c];
}

// Below the horizon the map shows even ground that reflects the light of the sky.
TEST(PreethamSky, Ground_SendsItsAlbedoOfTheSky) {
  const Environment sky = daySky({3.0, 0.8, 0.0, 0.5});
  EXPECT_NEAR(luminanceOf(radianceAt(sky, {0.3, -0.4, 0.2})), 0.5 / pi * illuminanceOf(sky), 1e-3);
  EXPECT_EQ(radianceAt(daySky({3.0, 0.8, 0.0, 0.0}), {0, -1, 0}), glm::vec3(0.0f));
}

TEST(PreethamSky, NumbersBeyondTheirRanges_AreUsageErrors) {
  EXPECT_THROW(daySky({1.0, 0.8, 0.0, 0.2}), UsageError);
  EXPECT_THROW(daySky({3.0, -0.1, 0.0, 0.2}), UsageError);
  EXPECT_THROW(daySky({3.0, 0.8, 0.0, 1.5}), UsageError);
  EXPECT_THROW(daySky({std::nan(""), 0.8, 0.0, 0.2}), UsageError);
}

}  // namespace
}  // namespace prelight
