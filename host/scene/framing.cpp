#include "scene/framing.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace prelight {

namespace {

constexpr double defaultAspect = 16.0 / 9.0;

}  // namespace

BoundingSphere boundingSphere(const CompiledScene& scene) {
  const glm::dvec3 lower(scene.boundsMin);
  const glm::dvec3 upper(scene.boundsMax);
  const double radius = 0.5 * glm::length(upper - lower);
  return {0.5 * (lower + upper), radius > 0.0 && std::isfinite(radius) ? radius : 1.0};
}

Camera frameCamera(const CompiledScene& scene) {
  const BoundingSphere sphere = boundingSphere(scene);
  Camera camera;
  camera.name = "framing";
  const double distance = sphereSlack * sphere.radius / std::sin(0.5 * camera.yFov);
  const glm::dvec3 centre = scene.origin + sphere.centre;
  const glm::dvec3 eye = centre + distance * glm::normalize(glm::dvec3(0.6, 0.45, 1.0));
  camera.world = glm::inverse(glm::lookAtRH(eye, centre, glm::dvec3(0.0, 1.0, 0.0)));
  camera.zNear = distance - sphereSlack * sphere.radius;
  camera.zFar = distance + sphereSlack * sphere.radius;
  return camera;
}

int pictureWidth(const Camera& camera, int height) {
  double aspect = camera.perspective ? camera.aspect : camera.xMag / camera.yMag;
  if (!(aspect > 0.0) || !std::isfinite(aspect)) aspect = defaultAspect;
  return std::max(1, static_cast<int>(std::lround(aspect * height)));
}

}  // namespace prelight
