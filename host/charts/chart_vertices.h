#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "prelight/light_map.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/load/file_triangles.h"

namespace prelight {

/// Vertices of one instance of a primitive, each with one place in the light map. A vertex where charts meet
/// appears several times.
struct ChartVertices {
  /// [vertex], index in the file's primitive; starts with all of its vertices in order.
  std::vector<std::uint32_t> source;
  std::vector<glm::vec2> coords;       ///< [vertex], 0..1, v down; 0 for vertices without a chart
  std::vector<std::uint32_t> indices;  ///< [3 x triangle of the file]
  std::size_t originals = 0;           ///< number of vertices of the file's primitive

  bool isSplit() const { return source.size() > originals; }
};

/// Finds the vertices for the fronts (firstFace 0) or the backs (firstFace triangleCount) of triangles.
/// Triangles without a chart keep their vertices.
ChartVertices findChartVertices(const FileTriangles& triangles, const LightMapLayout& layout,
                                std::size_t firstFace, std::size_t vertexCount);

/// Appends an accessor for a vertex attribute whose element i is element source[i] of `accessor`, and returns
/// its index. Sparse values are filled in, and elements begin at multiples of 4 bytes. Every source must be
/// in range. `negated` is [element of the copy], 1 for a negated value; if any is, values become floats.
/// Empty: none is negated.
int copyVertexAccessor(GltfDocument& document, std::size_t accessor, std::span<const std::uint32_t> source,
                       std::span<const std::uint8_t> negated = {});

}  // namespace prelight
