#include "benchmarks/truth/picture_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace prelight::benchmarks {
namespace {

constexpr int side = 100;
constexpr double off = 0.02;    // of the picture from the truth
constexpr double noise = 0.08;  // of a truth

Picture grey(double radiance) {
  return {side, side, std::vector<glm::vec3>(side * side, glm::vec3(static_cast<float>(radiance)))};
}

/// The same noise in all channels: the worst for what takes them for independent.
Picture noisy(double radiance, std::mt19937& random) {
  std::normal_distribution<float> scatter(static_cast<float>(radiance), static_cast<float>(noise));
  Picture picture = grey(0.0);
  for (glm::vec3& pixel : picture.pixels) pixel = glm::vec3(scatter(random));
  return picture;
}

TEST(PictureRmse, Differences_CountUpToWhite) {
  const Picture dark{2, 1, {glm::vec3(0.0f), glm::vec3(3.0f)}};
  const Picture other{2, 1, {glm::vec3(0.6f, 0.0f, 0.0f), glm::vec3(50.0f)}};
  EXPECT_NEAR(pictureRmse(dark, other), 0.6 / std::sqrt(6.0), 1e-6);
  EXPECT_EQ(pictureRmse(other, other), 0.0);
}

TEST(MeasuredError, WithoutNoise_IsTheRmse) {
  const Picture truth = grey(0.4), picture = grey(0.5);
  const MeasuredError error = errorBetween(picture, truth, truth);
  EXPECT_NEAR(error.rmse, 0.1, 1e-6);
  EXPECT_EQ(error.standardError, 0.0);
}

/// The noise is four times the error, so that the plain RMSE shows it and little else.
TEST(MeasuredError, OfNoisyTruths_HasNoNoiseInIt_AndKnowsItsOwnError) {
  std::mt19937 random(7);
  const Picture picture = grey(0.4 + off);
  constexpr int trials = 40;
  double sum = 0.0, squares = 0.0, stated = 0.0;
  for (int trial = 0; trial < trials; ++trial) {
    const Picture first = noisy(0.4, random), second = noisy(0.4, random);
    EXPECT_GT(pictureRmse(picture, first), 3.0 * off);
    const MeasuredError error = errorBetween(picture, first, second);
    sum += error.rmse;
    squares += (error.rmse - off) * (error.rmse - off);
    stated += error.standardError * error.standardError;
  }
  const double scatter = std::sqrt(squares / trials);
  EXPECT_NEAR(sum / trials, off, 4.0 * scatter / std::sqrt(double(trials)));
  EXPECT_LT(scatter, 0.2 * off);
  EXPECT_NEAR(std::sqrt(stated / trials) / scatter, 1.0, 0.35);  // 40 trials know it to a ninth
}

TEST(MeasuredError, WithinTheNoise_DoesNotDiffer) {
  EXPECT_TRUE(differ({0.02, 0.001}, {0.03, 0.001}));
  EXPECT_FALSE(differ({0.02, 0.004}, {0.03, 0.004}));
}

}  // namespace
}  // namespace prelight::benchmarks
