#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// A binary tree over a scene's occluders. Its roots are the file's nodes that have triangles, in the order
/// of CompiledScene::primitives; its leaves are clusters of their vertices. Indices are in order of creation,
/// so that a parent's is below its children's.
struct OccluderTree {
  std::vector<std::string> names;  ///< [tree node], nodeNameOf() of a root; NAME/0 and NAME/1 below NAME
  std::vector<int> parent;         ///< [tree node], -1 for a root
  std::vector<std::array<int, 2>> children;  ///< [tree node], both -1 for a leaf
  /// [vertex], tree node; the first leaf for vertices without triangle.
  std::vector<std::uint32_t> leafOfVertex;

  std::size_t size() const { return names.size(); }
  bool isLeaf(std::uint32_t node) const { return children[node][0] < 0; }
  std::size_t leafCount() const;
};

/// Makes a tree by splitting the cluster with the greatest spread of vertices (the sum of area x squared
/// distance to their mean) until there are `leaves` leaves: at the mean, across the direction of greatest
/// spread. There may be fewer leaves, as coincident vertices share one, and more if more nodes have
/// triangles. Takes O(vertices x depth) time; the result depends on the scene alone.
OccluderTree makeOccluderTree(const CompiledScene& scene, std::size_t leaves);

}  // namespace prelight
