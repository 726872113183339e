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

  /// [block], whether it may reach into the view of a clip matrix. Near and far planes leave nothing out, nor
  /// do sides that a block touches but for rounding.
  std::vector<bool> shownBy(const glm::mat4& clipFromScene) const;

 private:
  struct Bounds {
    glm::vec3 lower{3e38f}, upper{-3e38f};
  };

  std::vector<Bounds> bounds_;
};

/// Which triangles of a scene a view may show.
class ShownTriangles {
 public:
  ShownTriangles(const TriangleBlocks& blocks, const glm::mat4& clipFromScene)
      : shown_(blocks.shownBy(clipFromScene)) {}

  /// Calls `draw` for the parts of a range that may be shown, in their order.
  void forEach(const TriangleRange& range, const std::function<void(const TriangleRange&)>& draw) const;

 private:
  std::vector<bool> shown_;  ///< [block]
};

}  // namespace prelight::viewer
