// Reasons why lamps light nothing.
#include "scene/dark_lamps.h"

#include <gtest/gtest.h>

#include "support/materials.h"
#include "support/scenes.h"

namespace prelight {
namespace {

CompiledScene room() { return test::box(4, {-2.0f, 0.0f, -2.0f}, {2.0f, 3.0f, 2.0f}, true); }

Light lampAt(const glm::dvec3& position) {
  Light lamp;
  lamp.name = "Lamp";
  lamp.position = position;
  return lamp;
}

std::string reasonOf(const CompiledScene& scene, const Light& light) {
  const std::vector<std::string> reasons = reasonsForDarkness(scene, std::vector<Light>{light}, nullptr);
  return reasons.empty() ? "" : reasons.front();
}

bool tells(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(DarkLamps, LampInABulb_IsShutInByIt) {
  CompiledScene scene = room();
  test::append(scene, test::sphere(12, 0.05f, {0.0f, 2.5f, 0.0f}));
  scene.primitives[1].name = "bulb";
  const std::string reason = reasonOf(scene, lampAt({0.0, 2.5, 0.0}));
  EXPECT_TRUE(tells(reason, "\"Lamp\"")) << reason;
  EXPECT_TRUE(tells(reason, "shut in by node \"bulb\"")) << reason;
}

TEST(DarkLamps, LampOutsideOfAClosedRoom_MeetsBacks) {
  CompiledScene scene = room();
  scene.primitives[0].name = "room";
  EXPECT_TRUE(tells(reasonOf(scene, lampAt({5.0, 1.0, 0.0})), "backs"));
  Light sun = lampAt({});
  sun.type = LightType::Directional;
  sun.direction = {0.0, -1.0, 0.0};
  EXPECT_TRUE(tells(reasonOf(scene, sun), "backs"));
}

TEST(DarkLamps, LampOfNoIntensity_IsSaidToHaveNone) {
  Light lamp = lampAt({0.0, 1.0, 0.0});
  lamp.intensity = glm::vec3(0.0f);
  EXPECT_TRUE(tells(reasonOf(room(), lamp), "no intensity"));
}

TEST(DarkLamps, RangeThatEndsBeforeTheWalls_IsTold) {
  Light lamp = lampAt({0.0, 1.5, 0.0});
  lamp.range = 0.5f;
  const std::string reason = reasonOf(room(), lamp);
  EXPECT_TRUE(tells(reason, "range of 0.5 m")) << reason;
  EXPECT_TRUE(tells(reason, "1.5")) << reason;  // About 1.5 m to the floor.
}

TEST(DarkLamps, SpotThatPointsAway_IsTold) {
  Light spot = lampAt({0.0, 1.0, 0.0});
  spot.type = LightType::Spot;
  spot.direction = {0.0, 1.0, 0.0};
  EXPECT_TRUE(tells(reasonOf(test::ground(4, 2.0f), spot), "points away"));
  EXPECT_FALSE(tells(reasonOf(room(), spot), "points away"));
}

TEST(DarkLamps, EmissiveQuadThatFacesAway_IsTold) {
  CompiledScene scene = test::ground(4, 2.0f);
  test::append(scene, test::ground(1, 0.5f, 1.0f));  // Faces up, above the ground.
  scene.materials[1] = test::emitter(glm::vec3(5.0f));
  scene.primitives[1].name = "panel";
  const std::vector<std::string> reasons = reasonsForDarkness(scene, {}, nullptr);
  ASSERT_EQ(reasons.size(), 1u);
  EXPECT_TRUE(tells(reasons[0], "\"panel\"")) << reasons[0];
  EXPECT_TRUE(tells(reasons[0], "points away")) << reasons[0];
}

TEST(DarkLamps, BlackSkyAndNoLight_AreTold) {
  const Environment black = constantEnvironment(glm::vec3(0.0f));
  EXPECT_TRUE(tells(reasonsForDarkness(room(), {}, &black)[0], "sky is black"));
  EXPECT_TRUE(tells(reasonsForDarkness(room(), {}, nullptr)[0], "no lamp"));
}

TEST(DarkLamps, ManyLamps_AreCounted) {
  const std::vector<Light> lamps(9, lampAt({9.0, 1.0, 0.0}));
  const std::vector<std::string> reasons = reasonsForDarkness(room(), lamps, nullptr, 3);
  ASSERT_EQ(reasons.size(), 4u);
  EXPECT_TRUE(tells(reasons[3], "6 more"));
}

}  // namespace
}  // namespace prelight
