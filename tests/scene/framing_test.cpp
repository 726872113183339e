// Camera and units of models that come without them.
#include "scene/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/unit_guess.h"
#include "support/scenes.h"

namespace prelight {
namespace {

CompiledScene boxScene(const glm::vec3& half) {
  CompiledScene scene = test::box(1, -half, half, false);
  scene.boundsMin = -half;
  scene.boundsMax = half;
  scene.origin = {10.0, -20.0, 30.0};
  return scene;
}

/// The largest |x| and |y| of a scene's vertices in the picture, relative to its half size, and the smallest
/// depth.
glm::dvec3 extent(const CompiledScene& scene, const Camera& camera, double aspect) {
  const glm::dmat4 toCamera = glm::inverse(camera.world);
  const double tangent = std::tan(0.5 * camera.yFov);
  glm::dvec3 most(0.0, 0.0, 1e300);
  for (const glm::vec3& position : scene.positions) {
    const glm::dvec3 p(toCamera * glm::dvec4(scene.origin + glm::dvec3(position), 1.0));
    most.x = std::max(most.x, std::abs(p.x) / (-p.z * tangent * aspect));
    most.y = std::max(most.y, std::abs(p.y) / (-p.z * tangent));
    most.z = std::min(most.z, -p.z);
  }
  return most;
}

TEST(FrameModel, AnyBoxAtAnySize_FillsThePictureWithAMargin) {
  for (const double size : {1e-4, 1.0, 1e5})
    for (const glm::vec3& shape :
         {glm::vec3(1), glm::vec3(1, 0.01f, 1), glm::vec3(0.01f, 1, 0.01f), glm::vec3(9, 1, 1)})
      for (const double aspect : {0.4, 1.0, 16.0 / 9.0, 4.0}) {
        const CompiledScene scene = boxScene(shape * static_cast<float>(size));
        const Camera camera = frameModel(scene, aspect);
        const glm::dvec3 most = extent(scene, camera, aspect);
        EXPECT_NEAR(std::max(most.x, most.y), 0.86, 0.02) << size << " " << aspect;
        EXPECT_GT(most.z, 0.0);
        EXPECT_LT(camera.zNear, most.z);
        EXPECT_GT(camera.zNear, 0.01 * most.z);
      }
}

TEST(FrameModel, FlatModel_IsSeenFromHigherUp) {
  const auto rise = [](const glm::vec3& half) { return frameModel(boxScene(half), 1.0).world[2].y; };
  EXPECT_NEAR(rise(glm::vec3(1)), 0.36, 0.01);
  EXPECT_GT(rise({1, 0.01f, 1}), 0.55);
}

TEST(FrameModel, EmptySceneOrPoint_IsFinite) {
  CompiledScene point;
  point.positions = {glm::vec3(0.0f)};
  for (const CompiledScene& scene : {CompiledScene(), point}) {
    const Camera camera = frameModel(scene, 1.5);
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r) EXPECT_TRUE(std::isfinite(camera.world[c][r]));
    EXPECT_GT(camera.world[3].z, 0.0);
  }
}

TEST(UnitGuess, UsualSizes_AreMetres) {
  for (const float half : {0.01f, 0.5f, 20.0f, 200.0f})
    EXPECT_FALSE(guessUnit(boxScene(glm::vec3(half)), false).has_value()) << half;
  EXPECT_FALSE(guessUnit(boxScene(glm::vec3(0.9f)), true).has_value());
  EXPECT_FALSE(guessUnit(CompiledScene(), false).has_value());
}

/// A landscape of a kilometre and a machine part in millimetres have the same numbers, so that the size alone
/// proves no unit.
TEST(UnitGuess, LargeScenes_HaveTheirSizeSaid_AndNoUnit) {
  for (const float half : {300.0f, 900.0f, 40e3f, 1e7f}) {
    const auto large = guessUnit(boxScene(glm::vec3(half, 10.0f, 10.0f)), false);
    ASSERT_TRUE(large) << half;
    EXPECT_EQ(large->unit, "") << half;
    EXPECT_FALSE(large->scale) << half;
    ASSERT_EQ(large->remedies.size(), 2u);
    EXPECT_EQ(large->remedies[0].scale, 0.001);
    EXPECT_EQ(large->remedies[0].where, "if its numbers are millimetres");
  }
  EXPECT_NE(guessUnit(boxScene(glm::vec3(900, 100, 100)), false)->reason.find("1800 m"), std::string::npos);
}

TEST(UnitGuess, LargeFigures_AreInCentimetres) {
  const auto figure = guessUnit(boxScene(glm::vec3(30, 90, 20)), true);
  ASSERT_TRUE(figure);
  EXPECT_EQ(figure->unit, "centimetres");
  EXPECT_EQ(figure->scale.value_or(0.0), 0.01);
  EXPECT_EQ(guessUnit(boxScene(glm::vec3(300, 900, 200)), true)->unit, "millimetres");
}

/// No figure is that large in any unit, but a crowd in a landscape may be.
TEST(UnitGuess, FiguresInALandscape_HaveItsSizeSaid) {
  const auto crowd = guessUnit(boxScene(glm::vec3(20e3f)), true);
  ASSERT_TRUE(crowd);
  EXPECT_EQ(crowd->unit, "");
}

TEST(UnitGuess, Specks_HaveTheirSizeSaidInMillimetres) {
  const auto speck = guessUnit(boxScene(glm::vec3(1e-4f)), false);
  ASSERT_TRUE(speck);
  EXPECT_NE(speck->reason.find("0.2 mm"), std::string::npos) << speck->reason;
  ASSERT_EQ(speck->remedies.size(), 1u);
  EXPECT_EQ(speck->remedies[0].scale, 1000.0);
}

}  // namespace
}  // namespace prelight
