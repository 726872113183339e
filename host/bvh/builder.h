#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/compiled_scene.h"

namespace prelight {

struct Box {
  glm::vec3 lower{3.4e38f};
  glm::vec3 upper{-3.4e38f};

  void grow(const glm::vec3& p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  void grow(const Box& b) {
    lower = glm::min(lower, b.lower);
    upper = glm::max(upper, b.upper);
  }
  /// Half of the surface area; 0 for an empty box.
  float halfArea() const {
    const glm::vec3 d = glm::max(upper - lower, glm::vec3(0.0f));
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

/// A binary tree over the triangles of a scene, from which the device layouts are made.
struct BinaryBvh {
  struct Node {
    Box bounds;
    std::uint32_t left = 0;  ///< children, when count is 0
    std::uint32_t right = 0;
    std::uint32_t first = 0;  ///< leaf: triangleOrder[first .. first + count)
    std::uint32_t count = 0;  ///< 1..maxLeafSize in a leaf
  };
  static constexpr std::uint32_t maxLeafSize = 8;
  static constexpr std::uint32_t maxDepth = 64;

  std::vector<Node> nodes;                   ///< root is node 0; some slots are unused
  std::vector<std::uint32_t> triangleOrder;  ///< triangle indices of the scene, leaf by leaf
  std::uint32_t depth = 0;                   ///< levels
};

/// Binned SAH (Wald 2007) with 32 bins an axis; a leaf is priced by blocks of eight triangles, as it is
/// tested. The tree depends on the scene alone, not on the number of threads. The scene must have a triangle.
BinaryBvh buildBvh(const CompiledScene& scene);

}  // namespace prelight
