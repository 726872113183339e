#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"

namespace prelight {

/// Share of the way from a vertex to the object's centre at which rays from an object to the scene begin, so
/// that surfaces that the object touches do not hide everything.
constexpr float towardsMiddle = 0.02f;

struct ObjectBounds {
  glm::vec3 lower{std::numeric_limits<float>::max()};
  glm::vec3 upper{std::numeric_limits<float>::lowest()};
};

/// Returns the bounds of vertices in scene coordinates.
inline ObjectBounds boundsOf(const CompiledScene& scene, const VertexRange& range) {
  ObjectBounds bounds;
  for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
    bounds.lower = glm::min(bounds.lower, scene.positions[v]);
    bounds.upper = glm::max(bounds.upper, scene.positions[v]);
  }
  return bounds;
}

/// Returns the centre of their bounds.
inline glm::vec3 middleOf(const CompiledScene& scene, const VertexRange& range) {
  const ObjectBounds bounds = boundsOf(scene, range);
  return 0.5f * (bounds.lower + bounds.upper);
}

}  // namespace prelight
