#include "relight/device/light_projector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "basis/cube_map.h"
#include "basis/haar.h"
#include "basis/sh.h"
#include "basis/sh_rotation.h"
#include "prelight/error.h"
#include "support/devices.h"

namespace prelight {
namespace {

DeviceContext& projectorDevice() { return test::sharedDevice().context(); }

Environment noisySky(int width, int height) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  Environment sky{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    sky.radiance.emplace_back(uniform(random), uniform(random), uniform(random));
  sky.radiance[static_cast<std::size_t>(width * height / 3)] = {900.0f, 700.0f, 500.0f};  // A sun.
  return sky;
}

/// A sky that is smooth enough for samples at texels of a cube to equal their means.
Environment smoothSky(int width, int height) {
  Environment sky{width, height, {}};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const glm::dvec3 d = Environment::direction((column + 0.5) / width, (row + 0.5) / height);
      sky.radiance.emplace_back(1.0 + 0.5 * d.y, 1.0 + 0.4 * d.x * d.z, 0.6 + 0.3 * d.z);
    }
  return sky;
}

double norm(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum);
}

class SkyOrder : public ::testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(SkyOrder, ProjectSh_AgreesWithDoubleReference) {
  const auto [order, width] = GetParam();
  const Environment sky = noisySky(width, 29);
  LightProjector projector(projectorDevice(), width, 29, order);
  projector.setSky(sky);
  const std::vector<float> got = projector.projectSh();
  const std::vector<double> right = sh::projectEnvironment(sky, order);
  ASSERT_EQ(got.size(), right.size());
  const double tolerance = 2e-6 * norm(right);
  for (std::size_t i = 0; i < right.size(); ++i) ASSERT_NEAR(got[i], right[i], tolerance) << i;
  EXPECT_EQ(projector.projectSh(), got) << "the same sums again";
}

INSTANTIATE_TEST_SUITE_P(OrdersAndWidths, SkyOrder,
                         ::testing::Values(std::tuple{1, 64}, std::tuple{3, 61}, std::tuple{8, 64},
                                           std::tuple{8, 7}, std::tuple{32, 128}));

TEST(LightProjector, SkyOfAnotherSize_IsRefused) {
  LightProjector projector(projectorDevice(), 16, 8, 2);
  EXPECT_THROW(projector.setSky(noisySky(32, 8)), UsageError);
  projector.setSky(noisySky(16, 8));
  EXPECT_THROW(projector.projectWavelets(12, 2), UsageError);
}

TEST(LightProjector, ProjectHaar_IsTheTransformOfItsTexels) {
  const Environment sky = smoothSky(256, 128);
  LightProjector projector(projectorDevice(), 256, 128, 1);
  projector.setSky(sky);
  const int faceSize = 16;
  const std::vector<float> got = projector.projectWavelets(faceSize, 16);
  const CubeMap cube = cubeFromEnvironment(sky, faceSize);
  const std::size_t texels = cubeTexelCount(faceSize);
  ASSERT_EQ(got.size(), 3 * texels);
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> right(texels);
    for (std::size_t i = 0; i < texels; ++i) right[i] = double(cube.radiance[i][static_cast<int>(c)]);
    haar::forward(std::span<double>(right), faceSize);
    for (std::size_t i = 0; i < texels; ++i) ASSERT_NEAR(got[c * texels + i], right[i], 2e-3 * faceSize) << i;
    double difference = 0.0;
    for (std::size_t i = 0; i < texels; ++i)
      difference += std::pow(double(got[c * texels + i]) - right[i], 2);
    EXPECT_LT(std::sqrt(difference), 1e-3 * norm(right)) << "channel " << c;
  }
}

TEST(LightProjector, HaarOfAConstantSky_IsItsAverages) {
  const Environment sky = constantEnvironment({0.5f, 1.0f, 2.0f});
  LightProjector projector(projectorDevice(), sky.width, sky.height, 1);
  projector.setSky(sky);
  const std::vector<float> got = projector.projectWavelets(8, 2);
  for (std::size_t i = 0; i < got.size(); ++i) {
    const std::size_t channel = i / 384;
    const float average = 8.0f * std::ldexp(0.5f, static_cast<int>(channel));
    ASSERT_NEAR(got[i], i % 64 == 0 ? average : 0.0f, 1e-5) << i;
  }
}

glm::dmat3 someRotation() {
  const glm::dvec3 a = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  const glm::dvec3 b = glm::normalize(glm::cross(a, glm::dvec3(0.1, 1.0, 0.2)));
  return {a, b, glm::cross(a, b)};
}

TEST(BandRotator, SeveralFunctions_AgreeWithTheHost) {
  for (const int order : {1, 2, 6, 32}) {
    const auto n = static_cast<std::size_t>(order * order);
    std::mt19937 random(4);
    std::normal_distribution<float> normal;
    std::vector<float> functions(5 * n);
    for (float& value : functions) value = normal(random);
    BandRotator rotator(projectorDevice(), order);
    rotator.setRotation(someRotation());
    Buffer<float> in(projectorDevice(), std::span<const float>(functions)), out(projectorDevice(), 5 * n);
    rotator.rotate(in, out, 5);
    const std::vector<float> got = out.read();
    for (std::size_t f = 0; f < 5; f += order == 32 ? 4 : 1) {
      std::vector<double> right(functions.begin() + static_cast<std::ptrdiff_t>(f * n),
                                functions.begin() + static_cast<std::ptrdiff_t>((f + 1) * n));
      if (order < 32)
        right = sh::rotate(right, order, someRotation());
      else  // The quadrature of rotate() takes long at this order.
        sh::ShRotation(order, someRotation()).apply(right, right);
      for (std::size_t i = 0; i < n; ++i) ASSERT_NEAR(got[f * n + i], right[i], 5e-6) << order << ", " << i;
    }
  }
}

}  // namespace
}  // namespace prelight
