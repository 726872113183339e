#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

struct LoadContext;

/// A primitive's triangles as the file draws them, and the compiled scene's triangles for them.
struct FileTriangles {
  static constexpr std::uint32_t dropped = 0xffffffffu;

  std::vector<glm::uvec3> corners;  ///< [triangle of the file], vertices of the primitive
  /// [triangle of the file] triangle of the scene, or dropped: without area.
  std::vector<std::uint32_t> compiled;
  /// [triangle of the file] 1 when the scene's triangle is wound the other way: corners 1 and 2 are
  /// exchanged.
  std::vector<std::uint8_t> exchanged;

  /// Returns the corner of the scene's triangle for corner `corner` of the file's.
  std::size_t compiledCorner(std::size_t triangle, std::size_t corner) const {
    return exchanged[triangle] != 0 && corner > 0 ? 3 - corner : corner;
  }
};

/// Returns the triangles of a primitive with these corners, [triangle of the file], in the compiled scene.
FileTriangles fileTriangles(std::vector<glm::uvec3> corners, const CompiledScene& scene,
                            const PrimitiveRange& range);

/// Finds the FileTriangles for a scene that was compiled from a document; reads the document's meshes when
/// they are first needed.
class FileTrianglesFinder {
 public:
  /// The arguments must outlive this object.
  FileTrianglesFinder(const GltfDocument& document, const CompiledScene& scene);
  ~FileTrianglesFinder();

  FileTriangles of(const PrimitiveRange& range);

 private:
  const GltfDocument& document_;
  const CompiledScene& scene_;
  Warnings ignored_;
  std::unique_ptr<LoadContext> context_;
  std::optional<std::size_t> mesh_;  ///< the mesh that was read last
  Mesh read_;
};

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
