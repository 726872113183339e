#include "scene/surface/triangles.h"

namespace prelight {

// Two of the three edges belong to the triangle, so that most rays through an edge meet one of its two.
std::optional<double> distanceTo(const CompiledScene& scene, std::uint32_t triangle, const glm::dvec3& from,
                                 const glm::dvec3& direction) {
  const glm::uvec3& corners = scene.triangles[triangle];
  const glm::dvec3 a(scene.positions[corners.x]);
  const glm::dvec3 ab = glm::dvec3(scene.positions[corners.y]) - a;
  const glm::dvec3 ac = glm::dvec3(scene.positions[corners.z]) - a;
  const glm::dvec3 across = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, across);
  if (determinant == 0.0) return std::nullopt;
  const glm::dvec3 away = from - a;
  const double u = glm::dot(away, across) / determinant;
  if (u < 0.0 || u > 1.0) return std::nullopt;
  const glm::dvec3 turned = glm::cross(away, ab);
  const double v = glm::dot(direction, turned) / determinant;
  if (!(v >= 0.0 && u + v < 1.0)) return std::nullopt;
  return glm::dot(ac, turned) / determinant;
}

}  // namespace prelight
