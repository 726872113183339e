#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"
#include "shared/ray_types.h"

namespace prelight {

/// Share of the hemisphere that an object may hide at most to be left out.
constexpr double leastHidden = 1e-3;

/// Of the origins of rays to an object above the surface, of a ball's radius.
constexpr double rayLift = 1e-4;

/// A ball in scene coordinates.
struct ObjectBall {
  glm::dvec3 centre{0.0};
  double radius = 0.0;
};

/// Around some vertices, about the middle of their bounds.
ObjectBall ballAroundObject(const CompiledScene& scene, const VertexRange& range);

/// The cone around a ball as a point sees it.
struct ObjectCone {
  glm::dvec3 axis{0.0};
  double cosine = -1.0;  ///< of its half angle; -1: all around, where the point lies within the ball

  double solidAngle() const;
};

ObjectCone coneTowards(const ObjectBall& ball, const glm::dvec3& from);

/// Uniform within the cone; `point` in [0,1)^2.
glm::dvec3 directionInCone(const ObjectCone& cone, const glm::dvec2& point);

/// Rays towards a ball, spread evenly over its cone; `seed` scrambles them.
std::vector<device::Ray> raysAtBall(const ObjectBall& ball, const glm::dvec3& from, std::uint32_t count,
                                    std::uint32_t seed);

glm::dvec3 wayOf(const device::Ray& ray);

std::vector<std::uint32_t> trianglesOf(const VertexRange& range);

/// As far as a number goes; hits count in lengths of the way.
device::Ray rayAlong(const glm::dvec3& from, const glm::dvec3& way);

}  // namespace prelight
