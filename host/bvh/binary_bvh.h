#pragma once

#include <cstdint>
#include <vector>

#include "bvh/box.h"

namespace prelight {

/// A binary tree over the triangles of a scene, from which the device layouts are made.
struct BinaryBvh {
  struct Node {
    Box bounds;
    std::uint32_t left = 0;  ///< children, if count is 0
    std::uint32_t right = 0;
    std::uint32_t first = 0;         ///< leaf: triangleOrder[first .. first + count)
    std::uint32_t count : 31 = 0;    ///< 1..maxLeafSize in a leaf
    std::uint32_t wideRoot : 1 = 0;  ///< inner node that is also a node of the wide layout
  };
  static constexpr std::uint32_t maxLeafSize = 8;
  static constexpr std::uint32_t maxDepth = 64;

  std::vector<Node> nodes;  ///< root is node 0; parents come before their children
  /// Triangle indices of the scene, leaf by leaf. A triangle may be in several leaves, each of which bounds a
  /// part of it; together they bound all of it.
  std::vector<std::uint32_t> triangleOrder;
  std::uint32_t depth = 0;    ///< levels
  double buildSeconds = 0.0;  ///< wall clock time
};

}  // namespace prelight
