#include "scene/surface/surface_frame.h"

namespace prelight {

glm::mat3 surfaceFrame(const glm::vec3& normal) {
  // Few surfaces have exactly this normal.
  constexpr glm::vec3 axis(0.36f, 0.48f, 0.8f), across(0.8f, -0.6f, 0.0f);
  constexpr float leastSquare = 1e-8f;
  glm::vec3 tangent = axis - glm::dot(axis, normal) * normal;
  if (glm::dot(tangent, tangent) < leastSquare) tangent = across - glm::dot(across, normal) * normal;
  tangent = glm::normalize(tangent);
  return {tangent, glm::cross(normal, tangent), normal};
}

}  // namespace prelight
