#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>

#include "prelight/light_map.h"
#include "scene/gltf/file_triangles.h"

namespace prelight {

/// Returns where a corner of a file's triangle lies in a light map: 0..1, v down. `firstFace`: 0 for fronts,
/// the scene's number of triangles for backs. Nullopt where the triangle has no chart or is not in the scene.
inline std::optional<glm::vec2> cornerPlace(const LightMapLayout& layout, const FileTriangles& triangles,
                                            std::size_t firstFace, std::size_t triangle, std::size_t corner) {
  const std::uint32_t compiled = triangles.compiled[triangle];
  if (compiled == FileTriangles::dropped) return std::nullopt;
  const std::size_t face = firstFace + compiled;
  if (layout.chartOf[face] == LightMapLayout::noChart) return std::nullopt;
  return layout.corners[3 * face + triangles.compiledCorner(triangle, corner)] /
         glm::vec2(layout.width, layout.height);
}

}  // namespace prelight
