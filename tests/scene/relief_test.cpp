// Heights and horizons from normal textures, compared with the reliefs that the normals were made from.
#include "scene/surface/relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace prelight {
namespace {

using std::numbers::pi;
constexpr int size = 128;

/// Normal texture of a relief with the given slopes along u and upwards, in heights per texel.
Image normalsOf(const std::function<glm::dvec2(double column, double row)>& slopes) {
  Image image{"", size, size, {}};
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const glm::dvec2 slope = slopes(column, row);
      const glm::dvec3 n = glm::normalize(glm::dvec3(-slope, 1.0));
      for (int a = 0; a < 3; ++a)
        image.rgba.push_back(static_cast<std::uint8_t>(std::lround(127.5 * (n[a] + 1.0))));
      image.rgba.push_back(255);
    }
  return image;
}

constexpr double amplitude = 8.0, wave = 2.0 * pi / 64.0;

double grooves(double column) { return amplitude * std::cos(wave * column); }

Relief grooveRelief() {
  return Relief(normalsOf([](double column, double) {
                  return glm::dvec2(-amplitude * wave * std::sin(wave * column), 0.0);
                }),
                {}, 1.0);
}

TEST(Relief, Heights_AreThoseThatTheNormalsAreOf) {
  const Relief relief = grooveRelief();
  for (int row : {0, 50})
    for (int column = 0; column < size; ++column)
      EXPECT_NEAR(relief.heights()[static_cast<std::size_t>(row * size + column)], grooves(column),
                  0.03 * amplitude);
}

TEST(Relief, HeightsAlongV_GrowAsGreenPointsUp) {
  const Relief relief(
      normalsOf([](double, double row) { return glm::dvec2(0.0, amplitude * wave * std::sin(wave * row)); }),
      {}, 1.0);
  for (int row = 0; row < size; ++row)
    EXPECT_NEAR(relief.heights()[static_cast<std::size_t>(row * size + 3)], grooves(row), 0.03 * amplitude);
}

TEST(Relief, Horizons_AreThoseOfTheHeights) {
  const Relief relief = grooveRelief();
  for (const int column : {32, 40, 20, 0}) {
    const float* horizon = relief.horizonAt({(column + 0.5) / size, 0.5});
    for (int k = 0; k < Relief::azimuths; ++k) {
      const double x = std::cos(2.0 * pi * k / Relief::azimuths);
      double steepest = 0.0;
      for (double s = 0.5; s < 64.0; s += 0.25)
        steepest = std::max(steepest, (grooves(column + s * x) - grooves(column)) / s);
      EXPECT_NEAR(double(horizon[k]), steepest / std::sqrt(1.0 + steepest * steepest), 0.02)
          << column << " " << k;
    }
  }
}

TEST(Relief, OfAFlatTexture_HidesNothing) {
  const Relief relief(normalsOf([](double, double) { return glm::dvec2(0.0); }), {}, 3.0);
  for (int k = 0; k < Relief::azimuths; ++k) EXPECT_LT(relief.horizonAt({0.3, 0.7})[k], 0.02f);
}

}  // namespace
}  // namespace prelight
