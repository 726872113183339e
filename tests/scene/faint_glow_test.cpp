// Emitters that light the visible part of a model, and emitters that leave it dark.
#include "scene/faint_glow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/camera.h"
#include "support/scenes.h"

namespace prelight {
namespace {

/// Makes the triangles from `first` on emit.
void emitFrom(CompiledScene& scene, std::uint32_t first, float radiance) {
  CompiledMaterial lamp = scene.materials.front();
  lamp.emission = glm::vec3(radiance);
  scene.materials.push_back(lamp);
  for (std::uint32_t t = first; t < scene.triangleCount(); ++t)
    scene.triangleMaterials[t] = static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void addBox(CompiledScene& scene, const glm::vec3& lower, const glm::vec3& upper) {
  test::append(scene, test::box(2, lower, upper, false));
}

Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& middle) {
  Camera camera;
  camera.world = glm::inverse(glm::lookAtRH(eye, middle, glm::dvec3(0.0, 1.0, 0.0)));
  return camera;
}

bool glowsAsFramed(const CompiledScene& scene) { return onlyGlows(scene, frameModel(scene, 1.5)); }

/// A shade that is open below, with a bulb in it, on a stand.
CompiledScene shadedLamp(float radiance) {
  CompiledScene scene = test::box(2, {-0.3f, 0.48f, -0.3f}, {0.3f, 0.5f, 0.3f}, false);
  addBox(scene, {-0.3f, 0.2f, -0.3f}, {-0.28f, 0.48f, 0.3f});
  addBox(scene, {0.28f, 0.2f, -0.3f}, {0.3f, 0.48f, 0.3f});
  addBox(scene, {-0.28f, 0.2f, -0.3f}, {0.28f, 0.48f, -0.28f});
  addBox(scene, {-0.28f, 0.2f, 0.28f}, {0.28f, 0.48f, 0.3f});
  addBox(scene, {-0.05f, 0.5f, -0.05f}, {0.05f, 1.5f, 0.05f});
  const std::uint32_t bulb = scene.triangleCount();
  addBox(scene, {-0.04f, 0.28f, -0.04f}, {0.04f, 0.36f, 0.04f});
  emitFrom(scene, bulb, radiance);
  return scene;
}

TEST(FaintGlow, BulbInItsShade_LeavesTheModelDarkHoweverBright) {
  for (const float radiance : {0.05f, 1.0f, 40.0f})
    EXPECT_TRUE(glowsAsFramed(shadedLamp(radiance))) << radiance;
}

TEST(FaintGlow, BulbOfGlassAboutItsFilament_LetsTheLightOut) {
  CompiledScene scene = shadedLamp(10.0f);
  const std::uint32_t first = scene.triangleCount();
  addBox(scene, {-0.06f, 0.26f, -0.06f}, {0.06f, 0.38f, 0.06f});
  scene.materials.back().transmission = 1.0f;
  for (const bool clear : {true, false}) {
    for (std::uint32_t t = first; t < scene.triangleCount(); ++t)
      scene.triangleMaterials[t] = clear ? static_cast<std::uint32_t>(scene.materials.size() - 1) : 0;
    EXPECT_EQ(glowsAsFramed(scene), clear);  // Otherwise all light stays inside.
  }
}

TEST(FaintGlow, BulbThatLightsTheFloorOneSees_IsALamp) {
  for (const float radiance : {0.01f, 20.0f}) {
    CompiledScene scene = test::box(8, {-1.0f, -0.1f, -1.0f}, {1.0f, 0.0f, 1.0f}, false);
    const std::uint32_t bulb = scene.triangleCount();
    addBox(scene, {-0.1f, 0.4f, -0.1f}, {0.1f, 0.6f, 0.1f});
    emitFrom(scene, bulb, radiance);
    EXPECT_EQ(glowsAsFramed(scene), radiance < 1.0f) << radiance;
  }
}

/// The bulb lights the front of a wall. From behind, no lit surface is visible.
TEST(FaintGlow, Camera_DecidesWhatIsDark) {
  CompiledScene scene = test::box(8, {-1.0f, -1.0f, -0.1f}, {1.0f, 1.0f, 0.0f}, false);
  const std::uint32_t bulb = scene.triangleCount();
  addBox(scene, {-0.1f, -0.1f, 0.5f}, {0.1f, 0.1f, 0.7f});
  emitFrom(scene, bulb, 20.0f);
  EXPECT_FALSE(onlyGlows(scene, cameraAt({1.0, 0.5, 4.0}, {0.0, 0.0, 0.0})));
  EXPECT_TRUE(onlyGlows(scene, cameraAt({1.0, 0.5, -4.0}, {0.0, 0.0, 0.0})));
  EXPECT_TRUE(onlyGlows(scene, cameraAt({1.0, 0.5, 4.0}, {1.0, 0.5, 8.0})));  // Sees nothing.
}

/// Half of the visible surface is lit only at grazing angles, and the front is open.
TEST(FaintGlow, RoomWithoutAWall_IsLitByItsPanel) {
  CompiledScene scene = test::box(1, glm::vec3(-1.0f), glm::vec3(1.0f), true);
  const auto front = [&](std::uint32_t t) {
    return geometricNormal(scene, t).z < -0.5;  // The wall towards the camera faces back into the room.
  };
  std::vector<glm::uvec3> walls;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (!front(t)) walls.push_back(scene.triangles[t]);
  ASSERT_EQ(walls.size(), 10u);
  scene = test::sceneOf(scene.positions, walls);
  const std::uint32_t panel = scene.triangleCount();
  test::append(
      scene, test::sceneOf(
                 {{-0.25f, 0.99f, -0.2f}, {-0.25f, 0.99f, 0.2f}, {0.25f, 0.99f, 0.2f}, {0.25f, 0.99f, -0.2f}},
                 {{0, 2, 1}, {0, 3, 2}}));
  emitFrom(scene, panel, 15.0f);
  EXPECT_LT(geometricNormal(scene, panel).y, 0.0);
  EXPECT_FALSE(onlyGlows(scene, cameraAt({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0})));
  scene.materials.back().emission = glm::vec3(0.2f);
  EXPECT_TRUE(onlyGlows(scene, cameraAt({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0})));
}

/// A closed room that is lit by a dim panel below the ceiling, and a body that glows on its outside.
TEST(FaintGlow, PanelInARoom_IsALampAndOneOnTheOutsideIsNot) {
  for (const bool outside : {false, true})
    for (const float radiance : {0.05f, 1.0f}) {
      CompiledScene scene = test::box(4, glm::vec3(-2.0f), glm::vec3(2.0f), !outside);
      const std::uint32_t walls = scene.triangleCount();
      const float y = outside ? 2.01f : 1.9f, x = outside ? 0.5f : -0.5f;
      test::append(scene, test::sceneOf({{-x, y, -0.5f}, {-x, y, 0.5f}, {x, y, 0.5f}, {x, y, -0.5f}},
                                        {{0, 1, 2}, {0, 2, 3}}));
      emitFrom(scene, walls, radiance);
      for (std::uint32_t t = walls; t < scene.triangleCount(); ++t)
        EXPECT_EQ(geometricNormal(scene, t).y > 0.0, outside);
      EXPECT_EQ(glowsAsFramed(scene), outside) << radiance;
    }
}

TEST(FaintGlow, ModelThatShinesAllOver_ShowsItself) {
  CompiledScene scene = test::box(4, glm::vec3(-1.0f), glm::vec3(1.0f), false);
  EXPECT_FALSE(glowsAsFramed(scene));  // Nothing glows.
  emitFrom(scene, 0, 0.5f);
  EXPECT_FALSE(glowsAsFramed(scene));
  // As from a texture that is black except for a display.
  scene.materials.back().emission = glm::vec3(0.05f);
  EXPECT_TRUE(glowsAsFramed(scene));
  Light lamp;
  lamp.intensity = glm::vec3(1.0f);
  scene.lights = {lamp};
  EXPECT_FALSE(glowsAsFramed(scene));
}

}  // namespace
}  // namespace prelight
