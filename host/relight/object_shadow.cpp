#include "relight/object_shadow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "basis/sh_evaluate.h"
#include "receivers/sampling.h"
#include "relight/object_ball.h"

namespace prelight {

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

}  // namespace prelight
