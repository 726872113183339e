#include "relight/object_ball.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "receivers/sampling.h"
#include "relight/object_middle.h"

namespace prelight {

ObjectBall ballAroundObject(const CompiledScene& scene, const VertexRange& range) {
  const ObjectBounds bounds = boundsOf(scene, range);
  ObjectBall ball{0.5 * (glm::dvec3(bounds.lower) + glm::dvec3(bounds.upper)), 0.0};
  for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v)
    ball.radius = std::max(ball.radius, glm::distance(glm::dvec3(scene.positions[v]), ball.centre));
  return ball;
}

double ObjectCone::solidAngle() const { return 2.0 * std::numbers::pi * (1.0 - cosine); }

ObjectCone coneTowards(const ObjectBall& ball, const glm::dvec3& from) {
  const glm::dvec3 way = ball.centre - from;
  const double distance = glm::length(way);
  if (distance <= ball.radius * 1.0001) return {glm::dvec3(0.0, 1.0, 0.0), -1.0};
  const double sine = ball.radius / distance;
  return {way / distance, std::sqrt(1.0 - sine * sine)};
}

glm::dvec3 directionInCone(const ObjectCone& cone, const glm::dvec2& point) {
  const double z = 1.0 - point.x * (1.0 - cone.cosine), turn = 2.0 * std::numbers::pi * point.y;
  const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
  const glm::dvec3 other = std::abs(cone.axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(other, cone.axis)), up = glm::cross(cone.axis, right);
  return radius * (std::cos(turn) * right + std::sin(turn) * up) + z * cone.axis;
}

std::vector<device::Ray> raysAtBall(const ObjectBall& ball, const glm::dvec3& from, std::uint32_t count,
                                    std::uint32_t seed) {
  const ObjectCone cone = coneTowards(ball, from);
  std::vector<device::Ray> rays;
  for (std::uint32_t k = 0; k < count; ++k)
    rays.push_back(rayAlong(from, directionInCone(cone, sampling::sobol(k, sampling::hashInteger(seed)))));
  return rays;
}

glm::dvec3 wayOf(const device::Ray& ray) { return {ray.direction[0], ray.direction[1], ray.direction[2]}; }

std::vector<std::uint32_t> trianglesOf(const VertexRange& range) {
  std::vector<std::uint32_t> triangles(range.triangleCount);
  std::iota(triangles.begin(), triangles.end(), range.firstTriangle);
  return triangles;
}

device::Ray rayAlong(const glm::dvec3& from, const glm::dvec3& way) {
  const glm::vec3 p(from), w(way);
  return {{p.x, p.y, p.z}, PRELIGHT_NO_TRIANGLE, {w.x, w.y, w.z}, std::numeric_limits<float>::max()};
}

}  // namespace prelight
