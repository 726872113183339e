#include "scene/closed_bodies.h"

#include <gtest/gtest.h>

#include "support/scenes.h"

namespace prelight {
namespace {

CompiledScene glowing(CompiledScene scene) {
  scene.materials[0].emission = glm::vec3(2.0f);
  scene.materials[0].doubleSided = true;
  return scene;
}

CompiledScene lamp(bool inward) { return glowing(test::box(2, {-1, 0, -1}, {1, 0.2f, 1}, inward)); }

BodySide only(const CompiledScene& scene) {
  const std::vector<BodySide> sides = glowingBodies(scene);
  EXPECT_EQ(sides.size(), scene.primitives.size());
  return sides.empty() ? BodySide::Unclear : sides[0];
}

TEST(GlowingBodies, ClosedLamp_LightsWhatIsAroundIt_HoweverItsFacesGoRound) {
  EXPECT_EQ(only(lamp(false)), BodySide::Outside);
  EXPECT_EQ(only(lamp(true)), BodySide::Inside);
}

TEST(GlowingBodies, LampWithALidMissing_LightsOnBothSides) {
  CompiledScene open = lamp(false);
  open.triangles.pop_back();
  open.triangleMaterials.pop_back();
  open.triangleFlat.pop_back();
  --open.primitives[0].triangleCount;
  EXPECT_EQ(only(open), BodySide::Unclear);
}

TEST(GlowingBodies, RoomAroundThings_LightsThem) {
  CompiledScene room = glowing(test::box(2, {-2, -2, -2}, {2, 2, 2}, false));
  test::append(room, test::box(1, {-0.2f, -0.2f, -0.2f}, {0.2f, 0.2f, 0.2f}, false));
  EXPECT_EQ(only(room), BodySide::Unclear);
}

TEST(GlowingBodies, WhatDoesNotGlowOnBothSides_IsLeftToItsMaterial) {
  CompiledScene oneSided = lamp(false), dark = lamp(false);
  oneSided.materials[0].doubleSided = false;
  dark.materials[0].emission = glm::vec3(0.0f);
  EXPECT_EQ(only(oneSided), BodySide::Unclear);
  EXPECT_EQ(only(dark), BodySide::Unclear);
}

}  // namespace
}  // namespace prelight
