#include "benchmarks/truth/picture_error.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace prelight::benchmarks {
namespace {

constexpr int width = 96, height = 64;
using Pixels = std::vector<glm::vec3>;

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

// Values of flip-evaluator 1.7 for low dynamic range at its default of 67.02 pixels per degree. Green and
// blue differ by 1 by definition.
TEST(Flip, Pairs_AreMeasuredInTheirOrder_OrNotAtAll) {
  const Pixels edge = drawn([](int x, int) { return glm::vec3(x < 48 ? 0.0f : 1.0f); });
  const Pixels moved = drawn([](int x, int) { return glm::vec3(x < 49 ? 0.0f : 1.0f); });
  const Pixels green = drawn([](int, int) { return glm::vec3(0, 1, 0); });
  const Pixels blue = drawn([](int, int) { return glm::vec3(0, 0, 1); });
  const Pixels still = waves(0), shifted = waves(1);
  const std::array<DisplayedPair, 4> pairs = {
      {{still, still}, {still, shifted}, {edge, moved}, {green, blue}}};
  const std::vector<double> values = measureFlip(pairs, width, height);
  if (!canMeasureFlip()) {
    EXPECT_TRUE(values.empty());
    return;
  }
  ASSERT_EQ(values.size(), pairs.size());
  EXPECT_EQ(values[0], 0.0);
  EXPECT_NEAR(values[1], 0.114353, 2e-5);
  EXPECT_NEAR(values[2], 0.034488, 2e-5);
  EXPECT_NEAR(values[3], 1.0, 1e-4);
}

}  // namespace
}  // namespace prelight::benchmarks
