#include "charts/chart_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace prelight {
namespace {

/// Triangles of a convex polygon, as a fan around its first corner.
std::vector<glm::dvec2> fanOf(const std::vector<glm::dvec2>& polygon) {
  std::vector<glm::dvec2> corners;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    corners.insert(corners.end(), {polygon[0], polygon[i - 1], polygon[i]});
  return corners;
}

std::vector<glm::dvec2> turnedBy(double angle, std::vector<glm::dvec2> points) {
  for (glm::dvec2& p : points)
    p = {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
  return points;
}

double areaOf(const std::vector<glm::dvec2>& corners) {
  double sum = 0.0;
  for (std::size_t c = 0; c < corners.size(); c += 3) {
    const glm::dvec2 u = corners[c + 1] - corners[c], v = corners[c + 2] - corners[c];
    sum += 0.5 * std::abs(u.x * v.y - u.y * v.x);
  }
  return sum;
}

TEST(ChartShape, SquareAlongTheAxes_StaysAsItIs) {
  const std::vector<glm::dvec2> corners = fanOf({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const ChartShape shape = shapeOf(corners, 1.0);
  for (std::size_t c = 0; c < corners.size(); ++c)
    EXPECT_NEAR(glm::distance(shape.corners[c], corners[c]), 0.0, 1e-12) << c;
  EXPECT_NEAR(glm::distance(shape.size, glm::dvec2(1.0)), 0.0, 1e-12);
}

// The corners are cut off, so that most edges of the hull give a larger rectangle than the four long edges
// do.
TEST(ChartShape, RectangleWithoutItsCorners_LiesAlongItsSidesHoweverItIsTurned) {
  const std::vector<glm::dvec2> polygon{{0.2, 0}, {3, 0},   {3.2, 0.1}, {3.2, 0.9},
                                        {3, 1},   {0.2, 1}, {0, 0.9},   {0, 0.1}};
  for (int i = 0; i < 24; ++i) {
    const ChartShape shape = shapeOf(fanOf(turnedBy(0.1 + i * std::numbers::pi / 12.0, polygon)), 3.16);
    EXPECT_NEAR(shape.size.x, 3.2, 1e-9) << i;
    EXPECT_NEAR(shape.size.y, 1.0, 1e-9) << i;
  }
}

// The rectangles along all edges of a right triangle are equally large, as are those along the edges of a
// rectangle.
TEST(ChartShape, EqualRectangles_LieAlongTheLongestEdge) {
  for (int i = 0; i < 24; ++i) {
    const double angle = 0.1 + i * std::numbers::pi / 12.0;
    const ChartShape right = shapeOf(turnedBy(angle, {{0, 0}, {3, 0}, {0, 4}}), 6.0);
    EXPECT_NEAR(right.size.x, 5.0, 1e-9) << i;
    EXPECT_NEAR(right.size.y, 2.4, 1e-9) << i;
  }
}

// The hull has more edges than the number of directions that are tried.
TEST(ChartShape, HullOfThousandEdges_HasNearlyTheSmallestRectangle) {
  std::vector<glm::dvec2> polygon;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 1000.0;
    polygon.emplace_back(2.0 * std::cos(angle), std::sin(angle));
  }
  const ChartShape shape = shapeOf(fanOf(turnedBy(0.7, polygon)), 2.0 * std::numbers::pi);
  EXPECT_NEAR(shape.size.x * shape.size.y, 8.0, 0.01);
}

TEST(ChartShape, AnyCorners_FillTheirRectangleAndHaveTheArea) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    std::vector<glm::dvec2> corners;
    for (int c = 0; c < 9; ++c) corners.emplace_back(5.0 * unit(random), unit(random));
    const ChartShape shape = shapeOf(corners, 2.5);
    glm::dvec2 low(1e300), high(-1e300);
    for (const glm::dvec2& p : shape.corners) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    EXPECT_NEAR(glm::length(low), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(high, shape.size), 0.0, 1e-9);
    EXPECT_GE(shape.size.x, shape.size.y);
    EXPECT_NEAR(areaOf(shape.corners), 2.5, 1e-9);
  }
}

TEST(ChartOverlap, TrianglesSideBySide_AreFree) {
  const ChartShape shape{fanOf({{0, 0}, {3, 0}, {3, 1}, {2, 1}, {0, 1}}), {3, 1}};
  const std::vector<std::uint32_t> order{2, 0, 1};
  EXPECT_EQ(withoutOverlap(shape, order), (std::vector<std::uint8_t>{1, 1, 1}));
}

// Two triangles that overlap in a tenth of each other's height, and one elsewhere.
TEST(ChartOverlap, TheLaterOfTwoThatOverlap_IsNotFree) {
  const ChartShape shape{{{0, 0}, {1, 0}, {0, 1}, {0.45, 0.45}, {1, 0.45}, {0.45, 1}, {2, 0}, {3, 0}, {3, 1}},
                         {3, 1}};
  EXPECT_EQ(withoutOverlap(shape, std::vector<std::uint32_t>{0, 1, 2}), (std::vector<std::uint8_t>{1, 0, 1}));
  EXPECT_EQ(withoutOverlap(shape, std::vector<std::uint32_t>{2, 1, 0}), (std::vector<std::uint8_t>{0, 1, 1}));
}

}  // namespace
}  // namespace prelight
