#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/light_map.h"
#include "scene/gltf/file_triangles.h"

namespace prelight {

/// The vertices of one drawing of a primitive, each with one place in the light map. Where charts part, a
/// vertex is there several times.
struct ChartVertices {
  std::vector<std::uint32_t> source;   ///< [vertex], of the file's primitive; it begins with all of those
  std::vector<glm::vec2> coords;       ///< [vertex], 0..1, v down; 0 where no chart has the vertex
  std::vector<std::uint32_t> indices;  ///< [3 x triangle of the file]
  std::size_t originals = 0;           ///< of the file's primitive

  bool isSplit() const { return source.size() > originals; }
};

/// Of the fronts (firstFace 0) or the backs (firstFace triangleCount) of the triangles. Triangles without a
/// chart keep the vertices that they have.
ChartVertices findChartVertices(const FileTriangles& triangles, const LightMapLayout& layout,
                                std::size_t firstFace, std::size_t vertexCount);

}  // namespace prelight
