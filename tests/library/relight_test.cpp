#include "prelight/relight.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "prelight/prelight.h"

namespace prelight {
namespace {

using std::numbers::pi;

/// An open vertex that looks along +Z: T_lm = A_l / pi Y_lm(n) (docs/conventions.md).
HarmonicTransfer openVertices(int channels) {
  const std::vector<glm::dvec3> up{{0.0, 0.0, 1.0}};
  const std::vector<double> y = basisValues(HarmonicBasis::Sh, up, 3);
  const double factors[] = {1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 0.25, 0.25, 0.25, 0.25, 0.25};
  HarmonicTransfer transfer;
  transfer.order = 3;
  transfer.channels = channels;
  for (int row = 0; row < 2 * channels; ++row)
    for (std::size_t i = 0; i < 9; ++i)
      transfer.coefficients.push_back(static_cast<float>(factors[i] * y[i]));
  return transfer;
}

/// Under a uniform sky of radiance L an open vertex has the irradiance pi L, with one channel and with three.
TEST(Irradiance, OfAnOpenVertexUnderAnEvenSky_IsPiTimesItsRadiance) {
  const std::vector<double> light = projectSky(constantEnvironment({1.0f, 2.0f, 3.0f}), 4);
  for (const int channels : {1, 3}) {
    const std::vector<glm::vec3> lit = irradiance(openVertices(channels), light, 4);
    ASSERT_EQ(lit.size(), 2u);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(lit[1][c], pi * (1.0 + c), 1e-4);
  }
}

TEST(Irradiance, OfWaveletsUnderAnEvenSky_IsThatOfTheirAverages) {
  const std::vector<glm::vec3> cube = cubeOfSky(constantEnvironment({1.0f, 2.0f, 3.0f}), 2);
  std::vector<float> light(3 * 24);
  for (std::size_t t = 0; t < 24; ++t)
    for (std::size_t c = 0; c < 3; ++c) light[24 * c + t] = cube[t][static_cast<int>(c)];
  haarForward(light, 2);
  // Half the accessibility comes through face +Y, whose average has the index 8: 0.5 over the face size.
  const HaarTransfer transfer{.faceSize = 2, .offsets = {0, 1}, .indices = {8}, .values = {0.25f}};
  const std::vector<glm::vec3> lit = irradiance(transfer, light);
  ASSERT_EQ(lit.size(), 1u);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(lit[0][c], 0.5 * pi * (1.0 + c), 1e-4);
}

TEST(Irradiance, OfLightGroups_IsLinearInTheirColours) {
  const LightGroupTransfer transfer{.groups = {{"a"}, {"b"}}, .channels = 1, .coefficients = {0.5f, 0.25f}};
  const std::vector<glm::vec3> colors{{1.0f, 0.0f, 2.0f}, {0.0f, 4.0f, 4.0f}};
  const std::vector<glm::vec3> lit = irradiance(transfer, colors);
  ASSERT_EQ(lit.size(), 1u);
  EXPECT_NEAR(lit[0].x, 0.5 * pi, 1e-6);
  EXPECT_NEAR(lit[0].y, pi, 1e-6);
  EXPECT_NEAR(lit[0].z, 2.0 * pi, 1e-6);
}

TEST(Irradiance, LightThatDoesNotFit_IsRefused) {
  EXPECT_THROW(irradiance(openVertices(1), std::vector<double>(12, 0.0), 2), UsageError);
  EXPECT_THROW(irradiance(openVertices(1), std::vector<double>(26, 0.0), 3), UsageError);
  EXPECT_THROW(irradiance(HaarTransfer{.faceSize = 2, .offsets = {0}, .indices = {}, .values = {}},
                          std::vector<float>(3, 0.0f)),
               UsageError);
  EXPECT_THROW(irradiance(LightGroupTransfer{.groups = {{"a"}}, .coefficients = {}}, {}), UsageError);
}

}  // namespace
}  // namespace prelight
