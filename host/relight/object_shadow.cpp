#include "relight/object_shadow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "basis/sh_evaluate.h"
#include "occluders/occluder_record.h"
#include "receivers/sampling.h"
#include "relight/vertex_lights.h"

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

namespace {

using namespace device;

constexpr std::uint32_t raysToObject = 64;  ///< per vertex and object
constexpr std::size_t aimsAtOnce = 1u << 14;

/// Returns an upper bound of the share of the hemisphere that lies in the cone.
double mostHidden(const ObjectCone& cone, const glm::dvec3& normal) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cone.cosine * cone.cosine));
  if (cone.cosine > 0.0 && glm::dot(cone.axis, normal) < -sine) return 0.0;
  return std::min(1.0, cone.solidAngle() / std::numbers::pi);
}

}  // namespace

void ObjectShadowCaster::castAims(const CompiledScene& scene, std::span<const Aim> aims,
                                  const std::vector<Ray>& rays, std::uint32_t bakedTriangles,
                                  ObjectShadow& shadow) {
  if (rays.empty()) return;
  const std::vector<Hit> first = whole_.traceClosest(std::span<const Ray>(rays));
  const std::vector<Hit> behind = walls_.traceAny(std::span<const Ray>(rays));
  const auto bands = static_cast<std::size_t>(order_ * order_);
  std::vector<double> values(bands);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (first[i].triangle == PRELIGHT_NO_TRIANGLE || first[i].triangle < bakedTriangles) continue;
    const Aim& aim = aims[i / raysToObject];
    const glm::dvec3 way(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]);
    const double weight = aim.weight * std::max(0.0, glm::dot(way, glm::dvec3(scene.normals[aim.vertex])));
    shadow.hidden[aim.vertex] += static_cast<float>(weight);
    if (behind[i].triangle != PRELIGHT_NO_TRIANGLE) {
      shadow.surfaces[aim.vertex] += static_cast<float>(weight);
      continue;
    }
    sh::evaluate(glm::normalize(way), order_, values);
    for (std::size_t k = 0; k < bands; ++k)
      shadow.sky[aim.vertex * bands + k] += static_cast<float>(weight * values[k]);
  }
}

ObjectShadow ObjectShadowCaster::cast(const CompiledScene& scene, const VertexRange& baked,
                                      std::span<const VertexRange> objects) {
  const std::size_t vertices = baked.vertexCount;
  ObjectShadow shadow{std::vector<float>(vertices),
                      std::vector<float>(vertices * static_cast<std::size_t>(order_ * order_)),
                      std::vector<float>(vertices)};
  std::vector<Aim> aims;
  std::vector<Ray> rays;
  const auto flush = [&] {
    castAims(scene, aims, rays, baked.triangleCount, shadow);
    aims.clear();
    rays.clear();
  };
  for (const VertexRange& object : objects) {
    const ObjectBall ball = ballAroundObject(scene, object);
    for (std::uint32_t v = 0; v < vertices; ++v) {
      const glm::dvec3 normal(scene.normals[v]);
      const glm::dvec3 from = glm::dvec3(scene.positions[v]) + rayLift * ball.radius * normal;
      const ObjectCone cone = coneTowards(ball, from);
      if (mostHidden(cone, normal) < leastHidden) continue;
      aims.push_back({v, cone.solidAngle() / (std::numbers::pi * raysToObject)});
      for (std::uint32_t k = 0; k < raysToObject; ++k)
        rays.push_back(rayAlong(from, directionInCone(cone, sampling::sobol(k, sampling::hashInteger(v)))));
      if (aims.size() == aimsAtOnce) flush();
    }
  }
  flush();
  return shadow;
}

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
