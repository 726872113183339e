#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"
#include "shared/ray_types.h"

namespace prelight {

/// Share of the hemisphere below which a hidden part is ignored.
constexpr double leastHidden = 1e-3;

/// Distance of the origins of rays to an object from the surface, in radii of the ball.
constexpr double rayLift = 1e-4;

/// A ball in scene coordinates.
struct ObjectBall {
  glm::dvec3 centre{0.0};
  double radius = 0.0;
};

/// Returns a ball around vertices whose centre is that of their bounds.
ObjectBall ballAroundObject(const CompiledScene& scene, const VertexRange& range);

/// The cone around a ball, seen from a point.
struct ObjectCone {
  glm::dvec3 axis{0.0};
  double cosine = -1.0;  ///< cosine of its half angle; -1: all directions, as the point lies within the ball

  double solidAngle() const;
};

ObjectCone coneTowards(const ObjectBall& ball, const glm::dvec3& from);

/// Returns a uniformly distributed direction within the cone for `point` in [0,1)^2.
glm::dvec3 directionInCone(const ObjectCone& cone, const glm::dvec2& point);

/// Returns rays towards a ball that are spread evenly over its cone; `seed` scrambles them.
std::vector<device::Ray> raysAtBall(const ObjectBall& ball, const glm::dvec3& from, std::uint32_t count,
                                    std::uint32_t seed);

glm::dvec3 wayOf(const device::Ray& ray);

std::vector<std::uint32_t> trianglesOf(const VertexRange& range);

/// Returns an unlimited ray, whose hit distances are in lengths of `way`.
device::Ray rayAlong(const glm::dvec3& from, const glm::dvec3& way);

}  // namespace prelight
