#include "viewer/core/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "prelight/error.h"

namespace prelight::viewer {
namespace {

CompiledScene boxOf(const glm::vec3& half, const glm::dvec3& origin) {
  CompiledScene scene;
  scene.boundsMin = -half;
  scene.boundsMax = half;
  scene.origin = origin;
  return scene;
}

TEST(Camera, FrameCamera_AnyBox_ShowsAllOfIt) {
  for (const glm::vec3& half : {glm::vec3(1), glm::vec3(1e-4f), glm::vec3(1e5f), glm::vec3(100, 1, 0.01f)}) {
    for (const double aspect : {1.0, 16.0 / 9.0, 4.0}) {
      const CompiledScene scene = boxOf(half, {10, -20, 30});
      const CameraMatrices m = cameraMatrices(frameCamera(scene), scene, aspect);
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const glm::dvec4 clip = m.projection * m.view * glm::dvec4(sign * glm::dvec3(half), 1.0);
        ASSERT_GT(clip.w, 0.0);
        for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(clip[axis]), clip.w) << corner << " " << axis;
      }
    }
  }
}

TEST(Camera, FrameCamera_EmptyScene_IsFinite) {
  const CompiledScene scene;
  const CameraMatrices m = cameraMatrices(frameCamera(scene), scene, 1.0);
  EXPECT_TRUE(std::isfinite((m.projection * m.view * glm::dvec4(0, 0, 0, 1)).x));
  EXPECT_GT(frameCamera(scene).world[3].y, 0.0);  // Slightly above.
}

TEST(Camera, Matrices_TightenedPlanes_ClipNothingOfTheScene) {
  const CompiledScene scene = boxOf(glm::vec3(2), {0, 0, 0});
  Camera camera;
  camera.world = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 1.5));  // Within the scene.
  camera.zNear = 0.25;
  const CameraMatrices m = cameraMatrices(camera, scene, 1.0);
  const auto depth = [&](double z) {
    const glm::dvec4 clip = m.projection * m.view * glm::dvec4(0, 0, z, 1);
    return clip.z / clip.w;
  };
  EXPECT_NEAR(depth(1.5 - 0.25), -1.0, 1e-9);  // The camera's own near plane.
  EXPECT_LT(depth(-2.0), 1.0);
}

TEST(Camera, Matrices_OfAScaledNode_AreNotScaled) {
  const CompiledScene scene = boxOf(glm::vec3(1), {0, 0, 0});
  Camera camera;
  camera.world = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 5));
  Camera scaled = camera;
  scaled.world = camera.world * glm::scale(glm::dmat4(1.0), glm::dvec3(3));
  const glm::dmat4 difference =
      cameraMatrices(camera, scene, 1.0).view - cameraMatrices(scaled, scene, 1.0).view;
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(glm::length(difference[c]), 0.0, 1e-12);
}

TEST(Camera, Choose_IndexOutOfRange_IsAUsageError) {
  Scene scene;
  const CompiledScene compiled = boxOf(glm::vec3(1), {0, 0, 0});
  EXPECT_THROW(chooseCamera(scene, compiled, 0), UsageError);
  scene.cameras.resize(2);
  scene.cameras[1].name = "second";
  EXPECT_EQ(chooseCamera(scene, compiled, 1).name, "second");
  EXPECT_THROW(chooseCamera(scene, compiled, 2), UsageError);
}

TEST(Camera, PictureWidth_FollowsTheAspect) {
  Camera camera;
  EXPECT_EQ(pictureWidth(camera, 90), 160);
  camera.aspect = 2.0;
  EXPECT_EQ(pictureWidth(camera, 90), 180);
  camera.perspective = false;
  camera.xMag = 3.0;
  EXPECT_EQ(pictureWidth(camera, 90), 270);
}

}  // namespace
}  // namespace prelight::viewer
