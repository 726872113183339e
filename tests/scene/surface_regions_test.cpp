#include "scene/surface/surface_regions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "scene/builtin/builtin.h"
#include "scene/gltf/load/loader.h"
#include "support/scenes.h"

namespace prelight {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

CompiledScene builtin(const std::string& name) {
  Warnings warnings;
  return compileScene(loadScene(makeBuiltinScene(name), warnings), warnings);
}

/// Two squares that share the edge x = 0: one in the plane y = 0, the other turned up from it by `angle`.
CompiledScene hinge(double angle, bool turned = false) {
  const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
  const std::vector<glm::vec3> positions = {{-1, 0, 0}, {0, 0, 0}, {0, 0, 1}, {-1, 0, 1},
                                            {0, 0, 0},  {c, s, 0}, {c, s, 1}, {0, 0, 1}};
  std::vector<glm::uvec3> triangles = {{0, 2, 1}, {0, 3, 2}, {4, 6, 5}, {4, 7, 6}};
  if (turned)
    for (std::size_t t = 2; t < 4; ++t) std::swap(triangles[t].y, triangles[t].z);
  return test::sceneOf(positions, triangles);
}

TEST(SurfaceRegions, Cube_HasSix) {
  const CompiledScene scene = test::box(3, glm::vec3(-1.0f), glm::vec3(2.0f), false);
  const SurfaceRegions regions = makeSurfaceRegions(scene, 30.0 * degree);
  ASSERT_EQ(regions.count(), 6u);
  for (const double area : regions.areas) EXPECT_NEAR(area, 9.0, 1e-5);
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) EXPECT_EQ(regions.regionOf[t], t / 18);
}

TEST(SurfaceRegions, Cube_IsOneAboveRightAngles) {
  const CompiledScene scene = test::box(2, glm::vec3(-1.0f), glm::vec3(1.0f), false);
  EXPECT_EQ(makeSurfaceRegions(scene, 90.0 * degree).count(), 6u);  // At the limit: a crease.
  EXPECT_EQ(makeSurfaceRegions(scene, 91.0 * degree).count(), 1u);
}

TEST(SurfaceRegions, SmoothBall_IsOne) {
  EXPECT_EQ(makeSurfaceRegions(test::sphere(16, 1.0f, glm::vec3(3, 0, 0)), 30.0 * degree).count(), 1u);
}

TEST(SurfaceRegions, CreaseAngle_Divides) {
  EXPECT_EQ(makeSurfaceRegions(hinge(29.9 * degree), 30.0 * degree).count(), 1u);
  EXPECT_EQ(makeSurfaceRegions(hinge(30.0 * degree), 30.0 * degree).count(), 2u);
  EXPECT_EQ(makeSurfaceRegions(hinge(30.1 * degree), 30.0 * degree).count(), 2u);
  EXPECT_EQ(makeSurfaceRegions(hinge(-40.0 * degree), 30.0 * degree).count(), 2u);
}

TEST(SurfaceRegions, AngleOfZero_DividesEvenAPlane) {
  EXPECT_EQ(makeSurfaceRegions(test::ground(1, 1.0f), 0.0).count(), 2u);
}

TEST(SurfaceRegions, FrontsOnDifferentSides_DoNotJoin) {
  EXPECT_EQ(makeSurfaceRegions(hinge(0.0), 30.0 * degree).count(), 1u);
  EXPECT_EQ(makeSurfaceRegions(hinge(0.0, true), 30.0 * degree).count(), 2u);
}

TEST(SurfaceRegions, PrimitivesThatMeet_Join) {
  CompiledScene scene = test::ground(2, 1.0f);
  CompiledScene beside = test::ground(2, 1.0f);
  for (glm::vec3& p : beside.positions) p.x += 2.0f;
  test::append(scene, beside);
  CompiledScene apart = test::ground(2, 1.0f);
  for (glm::vec3& p : apart.positions) p.x += 5.0f;
  test::append(scene, apart);
  EXPECT_EQ(makeSurfaceRegions(scene, 30.0 * degree).count(), 2u);
}

TEST(SurfaceRegions, WallOnAFloor_LeavesTheFloorWhole) {
  CompiledScene scene = hinge(0.0);
  test::append(scene, test::sceneOf({{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}));
  const SurfaceRegions regions = makeSurfaceRegions(scene, 30.0 * degree);
  ASSERT_EQ(regions.count(), 2u);
  EXPECT_EQ(regions.regionOf, (std::vector<std::uint32_t>{0, 0, 0, 0, 1, 1}));
}

/// A triangle between two squares at a right angle is so thin that its normal is rounding noise. It must join
/// one of the squares and not connect them.
TEST(SurfaceRegions, Sliver_JoinsOneNeighbour) {
  CompiledScene scene = hinge(90.0 * degree);
  const float offset = 1e-7f;
  scene.positions[4].x = scene.positions[7].x = offset;
  test::append(scene,
               test::sceneOf({{0, 0, 0}, {offset, 0, 0}, {offset, 0, 1}, {0, 0, 1}}, {{0, 2, 1}, {0, 3, 2}}));
  const SurfaceRegions regions = makeSurfaceRegions(scene, 30.0 * degree);
  EXPECT_EQ(regions.count(), 2u);
  EXPECT_NE(regions.regionOf[0], regions.regionOf[2]);
}

TEST(SurfaceRegions, Nothing_HasNone) {
  const SurfaceRegions regions = makeSurfaceRegions(CompiledScene{}, 30.0 * degree);
  EXPECT_EQ(regions.count(), 0u);
  EXPECT_TRUE(regions.regionOf.empty());
}

TEST(SurfaceRegions, TrianglesWithoutArea_HaveARegionToo) {
  const CompiledScene scene =
      test::sceneOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 0, 1}, {0, 1, 3}});
  const SurfaceRegions regions = makeSurfaceRegions(scene, 30.0 * degree);
  ASSERT_EQ(regions.regionOf.size(), 3u);
  for (const std::uint32_t region : regions.regionOf) EXPECT_LT(region, regions.count());
  double sum = 0.0;
  for (const double area : regions.areas) sum += area;
  EXPECT_NEAR(sum, 0.5, 1e-12);
}

TEST(SurfaceRegions, RandomTriangles_AreApart) {
  const CompiledScene scene = test::randomSoup(500, 0.1f, 7);
  EXPECT_EQ(makeSurfaceRegions(scene, 30.0 * degree).count(), 500u);
}

TEST(SurfaceRegions, Cornell_HasRoomAndBoxes) {
  const CompiledScene scene = builtin("cornell");
  const SurfaceRegions regions = makeSurfaceRegions(scene, usualCreaseAngle);
  std::set<std::uint32_t> used(regions.regionOf.begin(), regions.regionOf.end());
  EXPECT_EQ(used.size(), regions.count());
  EXPECT_GE(regions.count(), 5u + 2u * 5u);  // The walls, and two boxes on the floor.
  EXPECT_LE(regions.count(), 5u + 2u * 6u + 6u);
}

}  // namespace
}  // namespace prelight
