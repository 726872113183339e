#include "scene/camera_axes.h"

#include <cmath>

namespace prelight {

namespace {

/// Returns true when nothing of the scene lies between the eye and the near plane.
bool nearPlaneCutsNothing(const Camera& camera, const CompiledScene& scene, double farthestAside) {
  const glm::dvec3 eye = glm::dvec3(camera.world[3]) - scene.origin;
  const glm::dvec3 lower = glm::dvec3(scene.boundsMin) - eye, upper = eye - glm::dvec3(scene.boundsMax);
  const double distance = glm::length(glm::max(glm::max(lower, upper), glm::dvec3(0.0)));
  return distance > camera.zNear * std::hypot(1.0, farthestAside);
}

}  // namespace

CameraAxes cameraAxes(const Camera& camera, const CompiledScene& scene, double aspect) {
  const double halfHeight = camera.perspective ? std::tan(0.5 * camera.yFov) : std::abs(camera.yMag);
  CameraAxes axes;
  axes.eye = glm::dvec3(camera.world[3]) - scene.origin;
  axes.right = halfHeight * aspect * glm::normalize(glm::dvec3(camera.world[0]));
  axes.up = halfHeight * glm::normalize(glm::dvec3(camera.world[1]));
  axes.forward = -glm::normalize(glm::dvec3(camera.world[2]));
  axes.perspective = camera.perspective;
  // Rays that start at the eye itself share their origin and are traced as bundles.
  const bool fromEye =
      camera.perspective && nearPlaneCutsNothing(camera, scene, halfHeight * std::hypot(1.0, aspect));
  axes.zNear = fromEye ? 0.0 : camera.zNear;
  return axes;
}

}  // namespace prelight
