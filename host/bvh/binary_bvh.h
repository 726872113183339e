#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// An axis-aligned box; a default-constructed one is empty.
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
  /// Returns half of the surface area; 0 for an empty box. In double precision, in which no finite box
  /// overflows.
  double halfArea() const {
    const glm::dvec3 d = glm::max(glm::dvec3(upper) - glm::dvec3(lower), glm::dvec3(0.0));
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

inline Box unite(Box a, const Box& b) {
  a.grow(b);
  return a;
}

inline Box intersect(const Box& a, const Box& b) {
  return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
}

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
