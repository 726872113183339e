#include "charts/light_map_lookup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace prelight {
namespace {

constexpr double none = LightMapLayout::noWall;

/// Walls where the line n.p = c crosses the square's edges.
SquareWalls lineAcross(const glm::dvec2& n, double c) {
  const auto share = [&](const glm::dvec2& from, const glm::dvec2& way) {
    const double s = (c - glm::dot(n, from)) / glm::dot(n, way);
    return static_cast<float>(s >= 0.0 && s <= 1.0 ? s : none);
  };
  return {share({0, 0}, {1, 0}), share({0, 1}, {1, 0}), share({0, 0}, {0, 1}), share({1, 0}, {0, 1})};
}

glm::dvec2 cornerOf(std::size_t i) { return {static_cast<double>(i % 2), static_cast<double>(i / 2)}; }

TEST(WalledSquare, NoWall_IsBilinear) {
  const std::array<double, 4> w = walledWeights({}, {0.25, 0.5}, true);
  EXPECT_NEAR(w[0], 0.375, 1e-5);
  EXPECT_NEAR(w[1], 0.125, 1e-5);
  EXPECT_NEAR(w[2], 0.375, 1e-5);
  EXPECT_NEAR(w[3], 0.125, 1e-5);
}

/// For a straight wall in any direction, one of the two answers uses the point's own side alone, and the
/// other mixes nothing from beyond the wall with it. So the darker answer shows no light of a lit side on a
/// dark one.
TEST(WalledSquare, StraightWall_ShowsTheDarkSideNothingOfTheLitOne) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int tried = 0;
  for (int i = 0; i < 20000; ++i) {
    const double angle = 6.283185307 * uniform(random);
    const glm::dvec2 n(std::cos(angle), std::sin(angle)), through(uniform(random), uniform(random));
    const double c = glm::dot(n, through);
    const SquareWalls walls = lineAcross(n, c);
    const glm::dvec2 p(uniform(random), uniform(random));
    if (!walls.any() || glm::dot(n, p) - c < 1e-6) continue;
    ++tried;
    double dark = 1.0, lit = 0.0;  // The light is 1 where n.p < c.
    for (const bool wide : {true, false}) {
      const std::array<double, 4> w = walledWeights(walls, p, wide);
      double sum = 0.0, all = 0.0;
      for (std::size_t k = 0; k < 4; ++k) {
        all += w[k];
        if (glm::dot(n, cornerOf(k)) < c) sum += w[k];
      }
      ASSERT_NEAR(all, 1.0, 1e-5);
      dark = std::min(dark, sum);
      lit = std::max(lit, sum);
    }
    ASSERT_EQ(dark, 0.0) << "line " << n.x << ' ' << n.y << ' ' << c << ", point " << p.x << ' ' << p.y;
  }
  EXPECT_GT(tried, 5000);
}

/// Away from the wall the lit side is not darkened either: both answers use that side alone.
TEST(WalledSquare, WallThroughOppositeEdges_LeavesBothSidesTheirLight) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const SquareWalls walls{static_cast<float>(uniform(random)), static_cast<float>(uniform(random))};
    const glm::dvec2 p(uniform(random), uniform(random));
    const double across = glm::mix(double(walls.top), double(walls.bottom), p.y);
    if (std::abs(p.x - across) < 5e-3) continue;
    for (const bool wide : {true, false}) {
      const std::array<double, 4> w = walledWeights(walls, p, wide);
      const double left = w[0] + w[2];
      ASSERT_NEAR(left, p.x < across ? 1.0 : 0.0, 1e-6);
    }
  }
}

/// Two walls that meet in a corner separate one texel from the others in the wide answer.
TEST(WalledSquare, CornerOfWalls_IsTheOuterAnswer) {
  const SquareWalls walls{0.6f, float(none), 0.4f, float(none)};
  const std::array<double, 4> wide = walledWeights(walls, {0.55, 0.35}, true);
  EXPECT_EQ(wide[0], 1.0);
  const std::array<double, 4> narrow = walledWeights(walls, {0.55, 0.35}, false);
  EXPECT_EQ(narrow[0], 0.0);
  EXPECT_EQ(walledWeights(walls, {0.65, 0.2}, true)[0], 0.0);
}

TEST(WalledSquare, EndOfAWall_LeavesOpenHowFarItGoes) {
  const SquareWalls walls{0.5f, float(none), float(none), float(none)};
  EXPECT_NEAR(walledWeights(walls, {0.25, 0.5}, true)[1], 0.0, 1e-6);
  EXPECT_NEAR(walledWeights(walls, {0.25, 0.5}, false)[1], 0.125, 1e-5);
}

}  // namespace
}  // namespace prelight
