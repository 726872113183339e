#include "scene/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

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

namespace {

constexpr double modelFov = 0.5235987755982988;  ///< 30 degrees, which distorts shapes little
constexpr double filledShare = 0.86;             ///< share of the picture that a framed model fills
/// Ratio of height to width below which models are seen from higher up.
constexpr double flat = 0.25;

/// Returns the direction from the model's centre to the eye.
glm::dvec3 modelView(const CompiledScene& scene) {
  const glm::dvec3 size(scene.boundsMax - scene.boundsMin);
  const double width = std::max(size.x, size.z);
  const double flatness = width > 0.0 ? std::clamp(1.0 - size.y / (flat * width), 0.0, 1.0) : 0.0;
  return glm::normalize(glm::dvec3(0.6, 0.45 + 0.45 * flatness, 1.0));
}

/// How far points reach to the four sides of a field of view whose apex is the origin: the greatest +-x +
/// tangent z, where z points against the view.
struct Reach {
  double right, left, up, down, front;

  void add(const glm::dvec3& point, double tangentX, double tangentY) {
    right = std::max(right, point.x + tangentX * point.z);
    left = std::max(left, -point.x + tangentX * point.z);
    up = std::max(up, point.y + tangentY * point.z);
    down = std::max(down, -point.y + tangentY * point.z);
    front = std::max(front, point.z);
  }
};

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

Camera frameModel(const CompiledScene& scene, double aspect) {
  const BoundingSphere sphere = boundingSphere(scene);
  Camera camera;
  camera.name = "framing";
  camera.yFov = modelFov;
  const double tangentY = filledShare * std::tan(0.5 * modelFov);
  const double tangentX = tangentY * (aspect > 0.0 && std::isfinite(aspect) ? aspect : 1.0);
  const glm::dmat3 axes(
      glm::inverse(glm::lookAtRH(modelView(scene), glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0))));
  constexpr double none = -std::numeric_limits<double>::infinity();
  Reach reach{none, none, none, none, none};
  for (const glm::vec3& position : scene.positions) {
    const glm::dvec3 seen = (glm::dvec3(position) - sphere.centre) * axes;
    if (std::isfinite(seen.x + seen.y + seen.z)) reach.add(seen, tangentX, tangentY);
  }
  if (reach.front == none) reach = {sphere.radius, sphere.radius, sphere.radius, sphere.radius, 0.0};
  const double distance =
      std::max({0.5 * (reach.right + reach.left) / tangentX, 0.5 * (reach.up + reach.down) / tangentY,
                reach.front + 0.1 * sphere.radius});
  const glm::dvec3 eye(0.5 * (reach.right - reach.left), 0.5 * (reach.up - reach.down), distance);
  camera.world = glm::dmat4(axes);
  camera.world[3] = glm::dvec4(scene.origin + sphere.centre + axes * eye, 1.0);
  camera.zNear = 0.5 * (distance - reach.front);
  camera.zFar = 0.0;
  return camera;
}

int pictureWidth(const Camera& camera, int height) {
  double aspect = camera.perspective ? camera.aspect : camera.xMag / camera.yMag;
  if (!(aspect > 0.0) || !std::isfinite(aspect)) aspect = defaultAspect;
  return std::max(1, static_cast<int>(std::lround(aspect * height)));
}

}  // namespace prelight
