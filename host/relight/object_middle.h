#pragma once

#include <glm/glm.hpp>
#include <limits>

#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"

namespace prelight {

/// Rays from an object to the scene begin this share of the way from the vertex to the object's middle, so
/// that what the object touches does not hide everything from it.
constexpr float towardsMiddle = 0.02f;

/// Of the bounds of some vertices, scene coordinates.
inline glm::vec3 middleOf(const CompiledScene& scene, const VertexRange& range) {
  glm::vec3 lower(std::numeric_limits<float>::max()), upper(std::numeric_limits<float>::lowest());
  for (std::uint32_t v = range.firstVertex; v < range.firstVertex + range.vertexCount; ++v) {
    lower = glm::min(lower, scene.positions[v]);
    upper = glm::max(upper, scene.positions[v]);
  }
  return 0.5f * (lower + upper);
}

}  // namespace prelight
