#include "viewer/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "base/error.h"

namespace prelight::viewer {
namespace {

constexpr double defaultAspect = 16.0 / 9.0;
/// Slack about the bounding sphere, so that what touches it is not cut by rounding.
constexpr double margin = 1.02;
/// Smallest near over far that a float depth buffer separates surfaces with.
constexpr double leastNearOverFar = 1e-6;

struct Sphere {
  glm::dvec3 center{0.0};  ///< scene coordinates
  double radius = 1.0;
};

Sphere boundingSphere(const CompiledScene& scene) {
  const glm::dvec3 lower(scene.boundsMin);
  const glm::dvec3 upper(scene.boundsMax);
  const double radius = 0.5 * glm::length(upper - lower);
  return {0.5 * (lower + upper), radius > 0.0 && std::isfinite(radius) ? radius : 1.0};
}

/// Rigid part of a camera's transform: a scaled node does not scale the picture.
glm::dmat4 withoutScale(const glm::dmat4& world) {
  glm::dmat4 rigid = world;
  for (int c = 0; c < 3; ++c) rigid[c] = glm::dvec4(glm::normalize(glm::dvec3(world[c])), 0.0);
  return rigid;
}

}  // namespace

Camera frameCamera(const CompiledScene& scene) {
  const Sphere sphere = boundingSphere(scene);
  Camera camera;
  camera.name = "framing";
  const double distance = margin * sphere.radius / std::sin(0.5 * camera.yFov);
  const glm::dvec3 center = scene.origin + sphere.center;
  const glm::dvec3 eye = center + distance * glm::normalize(glm::dvec3(0.6, 0.45, 1.0));
  camera.world = glm::inverse(glm::lookAtRH(eye, center, glm::dvec3(0.0, 1.0, 0.0)));
  camera.zNear = distance - margin * sphere.radius;
  camera.zFar = distance + margin * sphere.radius;
  return camera;
}

Camera chooseCamera(const Scene& scene, const CompiledScene& compiled, std::optional<int> index) {
  const int count = static_cast<int>(scene.cameras.size());
  if (!index) return count > 0 ? scene.cameras.front() : frameCamera(compiled);
  if (*index >= 0 && *index < count) return scene.cameras[*index];
  throw UsageError(
      "--camera " + std::to_string(*index),
      count == 0 ? "the scene has no cameras" : "the scene has cameras 0 to " + std::to_string(count - 1),
      count == 0 ? "leave the option out to frame the whole scene" : "");
}

int pictureWidth(const Camera& camera, int height) {
  double aspect = camera.perspective ? camera.aspect : camera.xMag / camera.yMag;
  if (!(aspect > 0.0) || !std::isfinite(aspect)) aspect = defaultAspect;
  return std::max(1, static_cast<int>(std::lround(aspect * height)));
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

  const Sphere sphere = boundingSphere(scene);
  const double depth = glm::dot(sphere.center - result.position, result.forward);
  const double reach = margin * sphere.radius;
  double zFar = depth + reach;
  if (camera.zFar > 0.0) zFar = std::min(zFar, camera.zFar);
  double zNear = std::max(camera.zNear, depth - reach);
  if (camera.perspective) zNear = std::max({zNear, zFar * leastNearOverFar, 1e-9});
  if (!(zFar > zNear)) zFar = zNear + reach;  // all of the scene is behind the camera
  if (camera.perspective) {
    result.projection = glm::perspectiveRH_NO(camera.yFov, aspect, zNear, zFar);
  } else {
    const double halfHeight = std::abs(camera.yMag);
    result.projection =
        glm::orthoRH_NO(-halfHeight * aspect, halfHeight * aspect, -halfHeight, halfHeight, zNear, zFar);
  }
  return result;
}

}  // namespace prelight::viewer
