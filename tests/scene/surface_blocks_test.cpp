// Solid angles of surfaces, signed by the visible side, and the first surface that a ray hits.
#include "scene/surface/surface_blocks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"

namespace prelight {
namespace {

double sum(const CompiledScene& scene, const glm::dvec3& point) {
  const SurfaceBlocks blocks(scene, std::vector<std::uint8_t>(scene.primitives.size(), 1));
  double all = 0.0;
  for (const double share : blocks.backShares(point)) all += share;
  return all;
}

TEST(BackShare, OctantTriangle_IsAnEighth) {
  const CompiledScene scene = test::sceneOf({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}});
  EXPECT_NEAR(backShare(scene, 0, {0.0, 0.0, 0.0}), 0.125, 1e-12);
  const CompiledScene reversed = test::sceneOf({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}});
  EXPECT_NEAR(backShare(reversed, 0, {0.0, 0.0, 0.0}), -0.125, 1e-12);
}

TEST(SurfaceBlocks, ClosedSurfaces_GiveTheirWindingNumber) {
  const CompiledScene ball = test::sphere(24, 1.0f, glm::vec3(0.0f));
  const CompiledScene room = test::box(6, glm::vec3(-1.0f), glm::vec3(1.0f), true);
  for (const glm::dvec3& within : {glm::dvec3(0.0), glm::dvec3(0.3, -0.5, 0.4), glm::dvec3(0.0, 0.9, 0.0)}) {
    EXPECT_NEAR(sum(ball, within), 1.0, 0.02);
    EXPECT_NEAR(sum(room, within), -1.0, 0.02);
  }
  for (const glm::dvec3& outside : {glm::dvec3(1.2, 0.0, 0.0), glm::dvec3(3.0, 4.0, 5.0)}) {
    EXPECT_NEAR(sum(ball, outside), 0.0, 0.02);
    EXPECT_NEAR(sum(room, outside), 0.0, 0.02);
  }
}

/// An open square covers its solid angle, signed by the side that is seen.
TEST(SurfaceBlocks, OpenSurface_CoversItsSolidAngle) {
  const CompiledScene ground = test::ground(32, 1.0f);
  // Solid angle of the square from h above its centre: 4 asin(a^2 / (a^2 + h^2)), with a half its side.
  for (const double height : {0.1, 1.0, 20.0}) {
    const double angle = 4.0 * std::asin(1.0 / (1.0 + height * height));
    EXPECT_NEAR(sum(ground, {0.0, height, 0.0}), -angle / (4.0 * 3.141592653589793), 0.002) << height;
    EXPECT_NEAR(sum(ground, {0.0, -height, 0.0}), angle / (4.0 * 3.141592653589793), 0.002) << height;
  }
}

TEST(SurfaceBlocks, FirstMet_IsTheNearestOfThoseThatCount) {
  CompiledScene scene = test::ground(4, 2.0f);
  test::append(scene, test::ground(4, 2.0f, 1.0f));
  const glm::dvec3 from(0.3, 3.0, 0.2), down(0.0, -2.0, 0.0);
  const auto met = SurfaceBlocks(scene, std::vector<std::uint8_t>{1, 1}).firstMet(from, down);
  ASSERT_TRUE(met);
  EXPECT_NEAR(met->distance, 1.0, 1e-12);
  EXPECT_FALSE(met->back);
  EXPECT_GE(met->triangle, scene.primitives[1].firstTriangle);
  const SurfaceBlocks lower(scene, std::vector<std::uint8_t>{1, 0});
  EXPECT_NEAR(lower.firstMet(from, down)->distance, 1.5, 1e-12);
  EXPECT_TRUE(lower.firstMet({0.3, -1.0, 0.2}, {0.0, 1.0, 0.0})->back);
  EXPECT_FALSE(lower.firstMet({5.0, 3.0, 0.0}, down));
}

}  // namespace
}  // namespace prelight
