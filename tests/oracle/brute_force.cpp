#include "oracle/brute_force.h"

namespace prelight::reference {

std::optional<ExactHit> closestHit(const CompiledScene& scene, const glm::dvec3& origin,
                                   const glm::dvec3& direction, double tMax, std::uint32_t source) {
  std::optional<ExactHit> best;
  for (std::uint32_t i = 0; i < scene.triangleCount(); ++i) {
    if (i == source) continue;
    const auto& t = scene.triangles[i];
    const glm::dvec3 a(scene.positions[t.x]);
    const glm::dvec3 e1 = glm::dvec3(scene.positions[t.y]) - a;
    const glm::dvec3 e2 = glm::dvec3(scene.positions[t.z]) - a;
    const glm::dvec3 s = origin - a;
    const double determinant = -glm::dot(direction, glm::cross(e1, e2));
    if (determinant == 0.0) continue;
    const double distance = glm::dot(s, glm::cross(e1, e2)) / determinant;
    const double u = glm::dot(direction, glm::cross(e2, s)) / determinant;
    const double v = glm::dot(direction, glm::cross(s, e1)) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || !(distance >= 0.0) || distance > tMax) continue;
    if (!best || distance < best->t) best = ExactHit{distance, i, u, v};
  }
  return best;
}

}  // namespace prelight::reference
