#include "relight/ground_shadow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "occluders/ball_form_factor.h"
#include "receivers/sampling.h"
#include "relight/object_middle.h"

namespace prelight {

namespace {

using namespace device;

constexpr std::uint32_t raysToGround = 32;  ///< per vertex

/// Returns the radius of a ball with the object's mean projected area, which for convex bodies is a quarter
/// of the surface (Cauchy).
double hidingRadius(const CompiledScene& scene, const VertexRange& object) {
  double area = 0.0;
  for (std::uint32_t t = 0; t < object.triangleCount; ++t)
    area += 0.5 * glm::length(geometricNormal(scene, object.firstTriangle + t));
  return std::sqrt(area / (4.0 * std::numbers::pi));
}

/// Returns the share of light that the object's ball leaves at the point that a ray hits.
double leftAt(const CompiledScene& scene, const Ray& ray, const Hit& hit, const glm::dvec3& middle,
              double radius) {
  const glm::dvec3 way(ray.direction[0], ray.direction[1], ray.direction[2]);
  const glm::dvec3 point = glm::dvec3(ray.origin[0], ray.origin[1], ray.origin[2]) + double(hit.t) * way;
  glm::dvec3 normal = glm::normalize(geometricNormal(scene, hit.triangle));
  if (glm::dot(normal, way) > 0.0) normal = -normal;
  const double distance = glm::distance(middle, point);
  // Below a distance of its radius, the ball no longer represents the object.
  const double sine = std::min(0.99, radius / std::max(distance, 1e-30));
  return 1.0 - ballFormFactor(glm::dot(normal, (middle - point) / std::max(distance, 1e-30)), sine);
}

}  // namespace

std::vector<double> shareBesideOwnShadow(const CompiledScene& scene, const VertexRange& object,
                                         Tracer& walls) {
  const glm::vec3 middle = middleOf(scene, object);
  std::vector<Ray> rays;
  for (std::uint32_t v = object.firstVertex; v < object.firstVertex + object.vertexCount; ++v)
    for (std::uint32_t k = 0; k < raysToGround; ++k) {
      const glm::vec3 from = glm::mix(scene.positions[v], middle, towardsMiddle);
      const glm::vec3 way(sampling::cosineHemisphere(sampling::sobol(k, sampling::hashInteger(v)),
                                                     glm::dvec3(scene.normals[v])));
      rays.push_back({{from.x, from.y, from.z},
                      PRELIGHT_NO_TRIANGLE,
                      {way.x, way.y, way.z},
                      std::numeric_limits<float>::max()});
    }
  const std::vector<Hit> hits = walls.traceClosest(std::span<const Ray>(rays));
  const double radius = hidingRadius(scene, object);
  std::vector<double> shares;
  for (std::size_t v = 0; v < object.vertexCount; ++v) {
    double sum = 0.0;
    int met = 0;
    for (std::size_t i = v * raysToGround; i < (v + 1) * raysToGround; ++i) {
      if (hits[i].triangle == PRELIGHT_NO_TRIANGLE) continue;
      sum += leftAt(scene, rays[i], hits[i], glm::dvec3(middle), radius);
      ++met;
    }
    shares.push_back(met == 0 ? 1.0 : sum / met);
  }
  return shares;
}

}  // namespace prelight
