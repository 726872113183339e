#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight::viewer {

/// Triangles of a scene that follow each other.
struct TriangleRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// Bounds of blocks of triangles that follow each other, by which a view leaves out what lies beside it.
class TriangleBlocks {
 public:
  static constexpr std::uint32_t trianglesOfABlock = 256;

  TriangleBlocks() = default;
  explicit TriangleBlocks(const CompiledScene& compiled);

  std::size_t count() const { return bounds_.size(); }

  /// Whether a block may reach into a view, whose rows are those of its clip matrix; its near and far planes
  /// leave nothing out. True also where the block touches a side but for rounding.
  bool mayShow(std::size_t block, const glm::mat4& clipFromScene) const;

 private:
  struct Bounds {
    glm::vec3 lower{3e38f}, upper{-3e38f};
  };

  std::vector<Bounds> bounds_;
};

/// Which triangles of a scene a view may show.
class ShownTriangles {
 public:
  ShownTriangles(const TriangleBlocks& blocks, const glm::mat4& clipFromScene);

  /// Calls `draw` for the parts of a range that may be shown, in their order.
  void forEach(const TriangleRange& range, const std::function<void(const TriangleRange&)>& draw) const;

 private:
  std::vector<bool> shown_;  ///< [block]
};

}  // namespace prelight::viewer
