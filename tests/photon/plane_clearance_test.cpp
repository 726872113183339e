#include "photon/density_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/scenes.h"

namespace prelight::test {
namespace {

constexpr double creaseAngle = std::numbers::pi / 6.0;

std::vector<float> clearanceOf(const CompiledScene& scene) {
  const SurfaceRegions regions = makeSurfaceRegions(scene, creaseAngle);
  const std::vector<std::uint8_t> planar(regions.count(), 1);
  return planeClearance(scene, regions, planar);
}

glm::vec3 cornerOf(const CompiledScene& scene, std::size_t triangle, int corner) {
  return scene.positions[scene.triangles[triangle][corner]];
}

TEST(PlaneClearance, Square_IsNowhereMoreThanTheWayToItsRimAndNearlyThatInTheMiddle) {
  const CompiledScene scene = ground(32, 1.0f);
  const std::vector<float> clearance = clearanceOf(scene);
  ASSERT_EQ(clearance.size(), scene.triangleCount());
  for (std::size_t t = 0; t < clearance.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 p = cornerOf(scene, t, k);
      EXPECT_LE(clearance[t], 1.0f - std::max(std::abs(p.x), std::abs(p.z)) + 1e-6f) << t;
    }
  EXPECT_GT(*std::max_element(clearance.begin(), clearance.end()), 0.9f);
}

TEST(PlaneClearance, Hole_CountsAsRim) {
  CompiledScene scene = ground(32, 1.0f);
  const std::size_t hole = scene.triangleCount() / 2 + 32;
  const glm::vec3 at = cornerOf(scene, hole, 0);
  scene.triangles.erase(scene.triangles.begin() + static_cast<std::ptrdiff_t>(hole));
  scene.triangleMaterials.erase(scene.triangleMaterials.begin() + static_cast<std::ptrdiff_t>(hole));
  const std::vector<float> clearance = clearanceOf(scene);
  for (std::size_t t = 0; t < clearance.size(); ++t)
    EXPECT_LE(clearance[t], glm::length(cornerOf(scene, t, 0) - at)) << t;
}

TEST(PlaneClearance, CurvedRegion_HasNone) {
  const CompiledScene scene = ground(4, 1.0f);
  const SurfaceRegions regions = makeSurfaceRegions(scene, creaseAngle);
  for (const float value : planeClearance(scene, regions, std::vector<std::uint8_t>(regions.count(), 0)))
    EXPECT_EQ(value, 0.0f);
}

}  // namespace
}  // namespace prelight::test
