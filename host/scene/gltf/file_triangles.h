#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "prelight/compiled_scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

struct LoadContext;

/// A primitive's triangles as the file draws them, and which of them a compiled scene has.
struct FileTriangles {
  static constexpr std::uint32_t dropped = 0xffffffffu;

  std::vector<glm::uvec3> corners;      ///< [triangle of the file], vertices of the primitive
  std::vector<std::uint32_t> compiled;  ///< [triangle of the file], of the scene, or dropped: without area
  /// [triangle of the file], 1: the scene's goes round the other way, corners 1 and 2 are exchanged.
  std::vector<std::uint8_t> exchanged;

  /// Corner of the scene's triangle that corner `corner` of the file's is.
  std::size_t compiledCorner(std::size_t triangle, std::size_t corner) const {
    return exchanged[triangle] != 0 && corner > 0 ? 3 - corner : corner;
  }
};

/// Finds them for a scene that was compiled from a document; reads the document's meshes once they are asked
/// for.
class FileTrianglesFinder {
 public:
  /// The arguments outlive it.
  FileTrianglesFinder(const GltfDocument& document, const CompiledScene& scene);
  ~FileTrianglesFinder();

  FileTriangles of(const PrimitiveRange& range);

 private:
  const GltfDocument& document_;
  const CompiledScene& scene_;
  Warnings ignored_;
  std::unique_ptr<LoadContext> context_;
};

}  // namespace prelight
