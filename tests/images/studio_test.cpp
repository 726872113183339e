// The built-in studio, and exposure metered from pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prelight/picture.h"

namespace prelight {
namespace {

/// Cosine-weighted mean of a sky's luminance about a normal, by texels.
double irradianceOverPi(const Environment& sky, const glm::dvec3& normal) {
  double sum = 0.0;
  const double texel = 2.0 * std::numbers::pi * std::numbers::pi / (double(sky.width) * sky.height);
  for (int row = 0; row < sky.height; ++row)
    for (int column = 0; column < sky.width; ++column) {
      const double v = (row + 0.5) / sky.height;
      const glm::dvec3 direction = Environment::direction((column + 0.5) / sky.width, v);
      const glm::vec3& radiance = sky.radiance[static_cast<std::size_t>(row) * sky.width + column];
      sum += std::max(0.0, glm::dot(direction, normal)) * radiance.y * texel * std::sin(std::numbers::pi * v);
    }
  return sum / std::numbers::pi;
}

TEST(Studio, Sky_IsFiniteAndPositiveEverywhere) {
  const Environment sky = studioEnvironment();
  ASSERT_EQ(sky.radiance.size(), static_cast<std::size_t>(sky.width) * sky.height);
  for (const glm::vec3& texel : sky.radiance)
    for (int c = 0; c < 3; ++c) ASSERT_TRUE(texel[c] > 0.05f && texel[c] < 10.0f) << texel[c];
}

/// White surfaces are about white without an exposure. Those that look up are brighter than those that look
/// down, and none is black.
TEST(Studio, WhiteSurfaces_AreLitFromAboveAndNeverBlack) {
  const Environment sky = studioEnvironment();
  const double up = irradianceOverPi(sky, {0, 1, 0});
  const double front = irradianceOverPi(sky, {0, 0, 1});
  const double down = irradianceOverPi(sky, {0, -1, 0});
  EXPECT_GT(up, front);
  EXPECT_GT(front, down);
  EXPECT_GT(down, 0.1);
  EXPECT_GT(front, 0.5);
  EXPECT_LT(up, 2.5);
  EXPECT_GT(irradianceOverPi(sky, {-1, 0, 0}), irradianceOverPi(sky, {1, 0, 0}));  // The main light.
}

Picture grey(float radiance) { return {10, 10, std::vector<glm::vec3>(100, glm::vec3(radiance))}; }

TEST(Exposure, EvenPicture_ComesOutBelowWhiteWhateverItsRadiance) {
  for (const float radiance : {1e-6f, 0.01f, 1.0f, 300.0f, 1e6f}) {
    const double exposure = meteredExposure(grey(radiance));
    EXPECT_NEAR(exposure * radiance, 0.5, 0.005) << radiance;
  }
}

TEST(Exposure, FewBrightPixels_AreLeftToTheToneMapper) {
  Picture picture = grey(0.4f);
  const double plain = meteredExposure(picture);
  picture.pixels[7] = glm::vec3(1000.0f);
  EXPECT_NEAR(meteredExposure(picture) / plain, 1.0, 0.1);
}

/// Half of the picture is a bright sky: objects in front of it must not go black.
TEST(Exposure, BrightBackground_DoesNotTurnTheRestBlack) {
  Picture picture = grey(0.1f);
  std::fill(picture.pixels.begin() + 50, picture.pixels.end(), glm::vec3(50.0f));
  EXPECT_GT(0.1 * meteredExposure(picture), 0.004);
}

TEST(Exposure, HasThreeDigits_SoThatTheNumberToldGivesTheSamePicture) {
  const double exposure = meteredExposure(grey(0.123456f));
  EXPECT_DOUBLE_EQ(exposure, std::stod(std::to_string(std::lround(exposure * 100.0))) / 100.0);
}

TEST(Exposure, BlackOrEmptyPictures_AreLeftAsTheyAre) {
  EXPECT_EQ(meteredExposure(grey(0.0f)), 1.0);
  EXPECT_EQ(meteredExposure({}), 1.0);
  EXPECT_EQ(meteredExposure(grey(std::nanf(""))), 1.0);
}

TEST(Exposure, Exposed_MultipliesRadiance) {
  EXPECT_EQ(exposed(grey(0.25f), 2.0).pixels[5], glm::vec3(0.5f));
  EXPECT_EQ(exposed(grey(0.3f), 1.0).pixels[5], glm::vec3(0.3f));
}

}  // namespace
}  // namespace prelight
