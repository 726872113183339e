#include "viewer/core/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "prelight/error.h"
#include "scene/camera.h"

namespace prelight::viewer {
namespace {

/// Smallest near over far that a float depth buffer separates surfaces with.
constexpr double leastNearOverFar = 1e-6;

/// Rigid part of a camera's transform: a scaled node does not scale the picture.
glm::dmat4 withoutScale(const glm::dmat4& world) {
  glm::dmat4 rigid = world;
  for (int c = 0; c < 3; ++c) rigid[c] = glm::dvec4(glm::normalize(glm::dvec3(world[c])), 0.0);
  return rigid;
}

}  // namespace

Camera chooseCamera(const Scene& scene, const CompiledScene& compiled, std::optional<int> index,
                    double aspect) {
  const int count = static_cast<int>(scene.cameras.size());
  if (!index) return count > 0 ? scene.cameras.front() : frameModel(compiled, aspect);
  if (*index >= 0 && *index < count) return scene.cameras[*index];
  throw UsageError(
      "--camera " + std::to_string(*index),
      count == 0 ? "the scene has no cameras" : "the scene has cameras 0 to " + std::to_string(count - 1),
      count == 0 ? "leave the option out to frame the whole scene" : "");
}

double halfHeightOf(const Camera& camera) {
  return camera.perspective ? std::tan(0.5 * camera.yFov) : std::abs(camera.yMag);
}

CameraMatrices cameraMatrices(const Camera& camera, const CompiledScene& scene, double aspect) {
  const glm::dmat4 world = withoutScale(camera.world);
  CameraMatrices result;
  result.perspective = camera.perspective;
  result.position = glm::dvec3(world[3]) - scene.origin;
  result.forward = -glm::dvec3(world[2]);
  glm::dmat4 inScene = world;
  inScene[3] = glm::dvec4(result.position, 1.0);
  result.view = glm::inverse(inScene);

  const BoundingSphere sphere = boundingSphere(scene);
  const double depth = glm::dot(sphere.centre - result.position, result.forward);
  const double reach = sphereSlack * sphere.radius;
  double zFar = depth + reach;
  if (camera.zFar > 0.0) zFar = std::min(zFar, camera.zFar);
  double zNear = std::max(camera.zNear, depth - reach);
  if (camera.perspective) zNear = std::max({zNear, zFar * leastNearOverFar, 1e-9});
  if (!(zFar > zNear)) zFar = zNear + reach;  // all of the scene is behind the camera
  if (camera.perspective) {
    result.projection = glm::perspectiveRH_NO(camera.yFov, aspect, zNear, zFar);
  } else {
    const double halfHeight = halfHeightOf(camera);
    result.projection =
        glm::orthoRH_NO(-halfHeight * aspect, halfHeight * aspect, -halfHeight, halfHeight, zNear, zFar);
  }
  return result;
}

}  // namespace prelight::viewer
