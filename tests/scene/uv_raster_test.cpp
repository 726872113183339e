#include "scene/surface/uv_raster.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace prelight {
namespace {

const auto center = [](int, int) { return glm::dvec2(0.5); };

const std::vector<glm::vec2> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(UvRaster, Square_CoversEveryPointOnce) {
  const std::vector<glm::uvec3> halves = {{0, 1, 2}, {0, 2, 3}};
  const UvRaster raster = rasterizeUv(square, halves, 16, 8, center);
  EXPECT_EQ(raster.covered, 128u);
  EXPECT_EQ(raster.overlapping, 0u);
  EXPECT_EQ(raster.triangles[15], 0u);      // Upper right.
  EXPECT_EQ(raster.triangles[7 * 16], 1u);  // Lower left.
}

TEST(UvRaster, TwiceTheSame_OverlapsEverywhere) {
  const std::vector<glm::uvec3> twice = {{0, 1, 2}, {2, 1, 0}};
  const UvRaster raster = rasterizeUv(square, twice, 64, 64, center);
  // Half of the square; points next to the diagonal may count for either triangle.
  EXPECT_NEAR(static_cast<double>(raster.covered), 2048.0, 64.0);
  EXPECT_NEAR(static_cast<double>(raster.overlapping), 2048.0, 130.0);
}

TEST(UvRaster, Thrice_CountsAPointOnce) {
  const std::vector<glm::uvec3> thrice = {{0, 1, 2}, {0, 1, 2}, {0, 1, 2}};
  const UvRaster raster = rasterizeUv(square, thrice, 32, 32, center);
  EXPECT_LE(raster.overlapping, raster.covered);
}

TEST(UvRaster, OutsideAndFlatTriangles_AreLeftOut) {
  const std::vector<glm::vec2> coords = {{2, 2}, {3, 2}, {3, 3}, {0.5f, 0.5f}};
  const std::vector<glm::uvec3> triangles = {{0, 1, 2}, {3, 3, 3}};
  const UvRaster raster = rasterizeUv(coords, triangles, 8, 8, center);
  EXPECT_EQ(raster.covered, 0u);
  EXPECT_TRUE(std::all_of(raster.triangles.begin(), raster.triangles.end(),
                          [](std::uint32_t t) { return t == UvRaster::nothing; }));
}

TEST(UvWeights, ReproduceThePoint) {
  const std::vector<glm::vec2> coords = {{0.1f, 0.2f}, {0.9f, 0.3f}, {0.4f, 0.8f}};
  const glm::dvec2 point(0.45, 0.4);
  const auto w = uvWeights(coords, {0, 1, 2}, point);
  const glm::dvec2 back =
      w[0] * glm::dvec2(coords[0]) + w[1] * glm::dvec2(coords[1]) + w[2] * glm::dvec2(coords[2]);
  EXPECT_NEAR(back.x, point.x, 1e-12);
  EXPECT_NEAR(back.y, point.y, 1e-12);
  EXPECT_NEAR(w[0] + w[1] + w[2], 1.0, 1e-12);
}

}  // namespace
}  // namespace prelight
