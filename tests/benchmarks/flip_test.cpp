#include "benchmarks/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace prelight::benchmarks {
namespace {

constexpr int width = 96, height = 64;
using Pixels = std::vector<glm::vec3>;

Pixels filled(const glm::vec3& color) { return Pixels(std::size_t{width} * height, color); }

template <typename Function>
Pixels drawn(const Function& function) {
  Pixels pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) pixels.push_back(function(x, y));
  return pixels;
}

Pixels waves(int shift) {
  return drawn([&](int x, int y) {
    return glm::vec3(0.5 + 0.4 * std::sin((x + shift) / 9.0), 0.5 + 0.4 * std::cos(y / 7.0),
                     0.3 + 0.2 * std::sin((x + shift + y) / 15.0));
  });
}

Pixels noise(std::uint32_t seed) {
  std::mt19937 random(seed);
  return drawn([&](int, int) {
    const auto next = [&] { return static_cast<float>(random() % 256) / 255.0f; };
    return glm::vec3(next(), next(), next());
  });
}

double flipOf(const Pixels& a, const Pixels& b) { return flip(a, b, width, height); }

TEST(Flip, EqualPictures_DifferByNothing) {
  for (const Pixels& pixels : {filled({0.2f, 0.5f, 0.9f}), waves(0), noise(1)})
    EXPECT_EQ(flipOf(pixels, pixels), 0.0);
}

TEST(Flip, ExchangedPictures_DifferAlike) {
  EXPECT_EQ(flipOf(waves(0), noise(1)), flipOf(noise(1), waves(0)));
}

TEST(Flip, EveryPixel_LiesBetweenNoneAndOne) {
  const std::vector<float> map = flipMap(noise(1), noise(2), width, height);
  ASSERT_EQ(map.size(), std::size_t{width} * height);
  EXPECT_GE(*std::min_element(map.begin(), map.end()), 0.0f);
  EXPECT_LE(*std::max_element(map.begin(), map.end()), 1.0f);
}

// The largest colour difference is defined as that of green and blue.
TEST(Flip, GreenAgainstBlue_IsOne) { EXPECT_NEAR(flipOf(filled({0, 1, 0}), filled({0, 0, 1})), 1.0, 1e-9); }

// L* differs by 100, a* and b* do not; green and blue, of CIELAB (87.73, -86.18, 83.18) and (32.30, 79.19,
// -107.86) with chroma scaled by L / 100, differ by 55.4 + sqrt(101.2^2 + 107.8^2) = 203.3: 0.95 + 0.05
// (100^0.7 / 203.3^0.7 - 0.4) / 0.6.
TEST(Flip, BlackAgainstWhite_IsNearlyOne) {
  const double share = std::pow(100.0 / 203.3, 0.7);
  EXPECT_NEAR(flipOf(filled(glm::vec3(0.0f)), filled(glm::vec3(1.0f))), 0.95 + 0.05 * (share - 0.4) / 0.6,
              2e-4);
}

TEST(Flip, ShiftByAPixel_IsSmallAndGrowsWithTheShift) {
  const double one = flipOf(waves(0), waves(1)), four = flipOf(waves(0), waves(4));
  EXPECT_GT(one, 0.0);
  EXPECT_LT(one, 0.15);
  EXPECT_GT(four, 1.5 * one);
}

TEST(Flip, FineNoise_CountsLessFromAfar) {
  const Pixels grey = filled(glm::vec3(0.5f));
  const Pixels checks = drawn([](int x, int y) { return glm::vec3((x + y) % 2 == 0 ? 0.4f : 0.6f); });
  EXPECT_LT(flip(checks, grey, width, height, 134.0), flip(checks, grey, width, height, 20.0));
}

// Values of the authors' own program (flip-evaluator 1.7 of PyPI, LDR, its default of 67.02 pixels a degree).
TEST(Flip, AuthorsProgram_SaysTheSame) {
  const Pixels edge = drawn([](int x, int) { return glm::vec3(x < 48 ? 0.0f : 1.0f); });
  const Pixels moved = drawn([](int x, int) { return glm::vec3(x < 49 ? 0.0f : 1.0f); });
  const Pixels darker = [] {
    Pixels pixels = waves(0);
    for (glm::vec3& pixel : pixels) pixel *= 0.8f;
    return pixels;
  }();
  EXPECT_NEAR(flipOf(waves(0), waves(1)), 0.114353, 2e-5);
  EXPECT_NEAR(flipOf(waves(0), darker), 0.570299, 2e-5);
  EXPECT_NEAR(flipOf(edge, moved), 0.034488, 2e-5);
}

}  // namespace
}  // namespace prelight::benchmarks
