#include "integrators/camera_upload.h"

#include <cmath>
#include <limits>

namespace prelight::reference {

namespace {

void store(float (&out)[3], const glm::dvec3& v) {
  for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(v[c]);
}

/// Whether nothing of the scene lies between the eye and the near plane.
bool nearPlaneCutsNothing(const Camera& camera, const CompiledScene& scene, double farthestAside) {
  const glm::dvec3 eye = glm::dvec3(camera.world[3]) - scene.origin;
  const glm::dvec3 lower = glm::dvec3(scene.boundsMin) - eye, upper = eye - glm::dvec3(scene.boundsMax);
  const double distance = glm::length(glm::max(glm::max(lower, upper), glm::dvec3(0.0)));
  return distance > camera.zNear * std::hypot(1.0, farthestAside);
}

}  // namespace

void setCamera(const Camera& camera, const CompiledScene& scene, int width, int height,
               device::ReferenceParameters& p) {
  const double aspect = static_cast<double>(width) / height;
  const double halfHeight = camera.perspective ? std::tan(0.5 * camera.yFov) : std::abs(camera.yMag);
  store(p.eye, glm::dvec3(camera.world[3]) - scene.origin);
  store(p.right, halfHeight * aspect * glm::normalize(glm::dvec3(camera.world[0])));
  store(p.up, halfHeight * glm::normalize(glm::dvec3(camera.world[1])));
  store(p.forward, -glm::normalize(glm::dvec3(camera.world[2])));
  p.perspective = camera.perspective ? 1 : 0;
  // Rays that leave the eye itself share their origin, and are traced as bundles.
  const bool fromEye =
      camera.perspective && nearPlaneCutsNothing(camera, scene, halfHeight * std::hypot(1.0, aspect));
  p.zNear = fromEye ? 0.0f : static_cast<float>(camera.zNear);
  p.zFar = camera.zFar > 0.0 && camera.zFar < 1e30 ? static_cast<float>(camera.zFar)
                                                   : std::numeric_limits<float>::max();
  p.width = static_cast<std::uint32_t>(width);
  p.height = static_cast<std::uint32_t>(height);
}

}  // namespace prelight::reference
