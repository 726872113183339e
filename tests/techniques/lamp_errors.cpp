#include "techniques/lamp_errors.h"

#include <cmath>
#include <random>

#include "oracle/brute_force.h"
#include "support/scenes.h"

namespace prelight::test {

double errorOfLamps(const CompiledScene& scene, const LampAtVertex& shown) {
  constexpr int places = 300, directions = 40;
  constexpr double leastCosine = 0.05;
  std::mt19937 random(7);
  std::uniform_int_distribution<std::uint32_t> triangles(0, scene.triangleCount() - 1);
  double sum = 0.0;
  int count = 0;
  for (int place = 0; place < places; ++place) {
    const std::uint32_t triangle = triangles(random);
    const std::uint32_t v = scene.triangles[triangle].x;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(scene.normals[v]));
    glm::dvec3 middle(0.0);
    for (int k = 0; k < 3; ++k) middle += glm::dvec3(scene.positions[scene.triangles[triangle][k]]) / 3.0;
    for (int d = 0; d < directions; ++d) {
      const glm::dvec3 way(randomDirection(random));
      const double cosine = glm::dot(way, normal);
      if (cosine < leastCosine) continue;
      const bool seen = !reference::closestHit(scene, middle + 1e-4 * normal, way, 1e9, triangle);
      sum += std::pow(shown(v, way, cosine) - (seen ? cosine : 0.0), 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

}  // namespace prelight::test
