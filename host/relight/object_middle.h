#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"

namespace prelight {

/// Rays from an object to the scene begin this share of the way from the vertex to the object's middle, so
/// that what the object touches does not hide everything from it.
constexpr float towardsMiddle = 0.02f;

struct ObjectBounds {
  glm::vec3 lower{std::numeric_limits<float>::max()};
  glm::vec3 upper{std::numeric_limits<float>::lowest()};
};

/// Of some vertices, scene coordinates.
inline ObjectBounds boundsOf(const CompiledScene& scene, const VertexRange& range) {
  ObjectBounds bounds;
  for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
    bounds.lower = glm::min(bounds.lower, scene.positions[v]);
    bounds.upper = glm::max(bounds.upper, scene.positions[v]);
  }
  return bounds;
}

/// Of their bounds.
inline glm::vec3 middleOf(const CompiledScene& scene, const VertexRange& range) {
  const ObjectBounds bounds = boundsOf(scene, range);
  return 0.5f * (bounds.lower + bounds.upper);
}

}  // namespace prelight
