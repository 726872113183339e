// Thickness of bodies, compared with closed forms, and the light that passes through them.
#include <gtest/gtest.h>

#include <cmath>

#include "support/run_bake.h"
#include "support/scenes.h"
#include "techniques/shading.h"
#include "techniques/thickness/thickness.h"

namespace prelight {
namespace {

Bake thicknessOf(const CompiledScene& scene, std::uint64_t rays) {
  BakeRequest request;
  request.thickness = true;
  request.effort.rays = rays;
  return test::runBake(scene, request).bake;
}

/// A chord at the angle t to the normal is 2 r cos t long, so that its cosine-weighted mean is 4 r / 3.
TEST(Thickness, OfASphere_IsTwoThirdsOfItsDiameter) {
  const Bake bake = thicknessOf(test::sphere(24, 0.5f, {3, 1, 2}), 1 << 12);
  ASSERT_FALSE(bake.thickness.empty());
  double sum = 0.0;
  for (const float thickness : bake.thickness) {
    EXPECT_NEAR(thickness, 2.0 / 3.0, 0.02);
    sum += thickness;
  }
  EXPECT_NEAR(sum / static_cast<double>(bake.thickness.size()), 2.0 / 3.0, 0.005);
}

/// A ray at the angle t to the normal runs d / cos t through a slab, so that the cosine-weighted mean is 2 d.
/// The rim, which shortens some rays, is 400 d away.
TEST(Thickness, OfASlab_IsTwiceItsHeight) {
  constexpr float height = 0.1f, half = 40.0f;
  const CompiledScene scene = test::box(2, {-half, 0, -half}, {half, height, half}, false);
  const Bake bake = thicknessOf(scene, 1 << 14);
  std::size_t middles = 0;
  for (std::size_t v = 0; v < scene.positions.size(); ++v) {
    if (scene.positions[v].x != 0.0f || scene.positions[v].z != 0.0f) continue;
    EXPECT_NEAR(bake.thickness[v], 2.0 * height, 0.02 * height);
    ++middles;
  }
  EXPECT_EQ(middles, 2u) << "the middles of bottom and top";
}

TEST(Thickness, OfASheet_IsNothing) {
  for (const float thickness : thicknessOf(test::ground(2, 1.0f), 64).thickness) EXPECT_EQ(thickness, 0.0f);
}

/// Lengths are metres of the scene, and a body does not see what lies outside.
TEST(Thickness, OfALargerBodyBesideAnother_GrowsWithIt) {
  CompiledScene scene = test::sphere(24, 2.0f, {0, 0, 0});
  const std::size_t own = scene.positions.size();
  test::append(scene, test::ground(1, 10.0f, -2.5f));
  const Bake bake = thicknessOf(scene, 1 << 12);
  for (std::size_t v = 0; v < own; ++v) EXPECT_NEAR(bake.thickness[v], 8.0 / 3.0, 0.08);
}

TEST(ThicknessShading, Passage_IsWhatTheMaterialsAbsorptionLeaves) {
  CompiledScene scene = test::ground(1, 1.0f);
  scene.materials[0].absorption = {0.5f, 1.0f, 2.0f};
  Bake bake;
  bake.thickness.assign(scene.vertexCount(), 0.7f);
  for (const glm::vec3& passed : thicknessShading.vertexNumbers(bake, scene))
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(passed[c], std::exp(-0.7 * scene.materials[0].absorption[c]), 1e-6);
}

TEST(ThicknessShading, PassageOfClearBodies_IsOneOverEAtTheirMeanThickness) {
  const CompiledScene scene = test::ground(1, 1.0f);
  Bake bake;
  bake.thickness = {0.0f, 1.0f, 2.0f, 3.0f};  // the first lies on no body
  const std::vector<glm::vec3> passed = thicknessShading.vertexNumbers(bake, scene);
  EXPECT_NEAR(passed[0].x, 1.0, 1e-6);
  EXPECT_NEAR(passed[2].y, std::exp(-1.0), 1e-6);
  EXPECT_NEAR(passed[3].z, std::exp(-1.5), 1e-6);
}

}  // namespace
}  // namespace prelight
