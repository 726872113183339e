#include "charts/light_map_charts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"

namespace prelight {
namespace {

/// n x n boxes under a floor that is another primitive. `share` is the ratio of a box's side to a cell of the
/// grid.
CompiledScene boxes(std::uint32_t n, float share, float scale = 1.0f) {
  const float cell = 20.0f * scale / float(n), side = share * cell;
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t i = 0; i < n * n; ++i) {
    const glm::vec3 low(cell * float(i % n) - 10.0f * scale, -2.0f * side,
                        cell * float(i / n) - 10.0f * scale);
    const CompiledScene box = test::box(1, low, low + side, false);
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), box.positions.begin(), box.positions.end());
    for (const glm::uvec3& t : box.triangles) triangles.push_back(t + first);
  }
  CompiledScene scene = test::sceneOf(std::move(positions), std::move(triangles));
  test::append(scene, test::ground(1, 10.0f * scale));
  return scene;
}

TEST(UsualTexels, FewPieces_HaveTheFewest) {
  EXPECT_EQ(usualTexels(test::ground(1, 3.0f)).count, fewestUsualTexels);
  EXPECT_EQ(usualTexels(test::sphere(32, 1.0f, glm::vec3(0.0f))).count, fewestUsualTexels);
  EXPECT_EQ(usualTexels(boxes(2, 0.8f)).count, fewestUsualTexels);
}

TEST(UsualTexels, ManyPieces_HaveMore_ByTheCubicRootOfTheirNumber) {
  const double few = usualTexels(boxes(8, 0.8f)).count, many = usualTexels(boxes(16, 0.8f)).count;
  EXPECT_GT(few, 1.5 * fewestUsualTexels);
  EXPECT_NEAR(many / few, std::cbrt(4.0), 0.1);
  EXPECT_LE(usualTexels(boxes(60, 0.8f)).count, mostUsualTexels);
  EXPECT_NEAR(usualTexels(boxes(60, 0.8f)).count / (fewestUsualTexels * std::cbrt(6.0 * 60 * 60 / 60.0)), 1.0,
              0.05);
}

TEST(UsualTexels, SizeOfTheScene_DoesNotMatter) {
  EXPECT_EQ(usualTexels(boxes(8, 0.8f, 0.01f)).count, usualTexels(boxes(8, 0.8f)).count);
  EXPECT_EQ(usualTexels(boxes(8, 0.8f, 50.0f)).count, usualTexels(boxes(8, 0.8f)).count);
}

TEST(UsualTexels, PiecesOfNextToNoArea_DoNotCount) {
  EXPECT_EQ(usualTexels(boxes(20, 0.001f)).count, fewestUsualTexels);
}

TEST(UsualTexels, SurfacesWithoutLight_DoNotCount) {
  CompiledScene scene = boxes(8, 0.8f);
  scene.materials[0].albedo = glm::vec3(0.0f);
  EXPECT_EQ(usualTexels(scene).count, fewestUsualTexels);
  EXPECT_NEAR(usualTexels(scene).area, 400.0, 1e-3);
}

}  // namespace
}  // namespace prelight
