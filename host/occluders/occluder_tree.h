#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// A binary tree over a scene's occluders. Its roots are the file's nodes that have triangles, in the order
/// of CompiledScene::primitives; its leaves are clusters of their vertices. Ids are indices into the arrays,
/// in order of creation: a parent's is below its children's.
struct OccluderTree {
  std::vector<std::string> names;            ///< [tree node], nodeNameOf a root; NAME/0, NAME/1 below NAME
  std::vector<int> parent;                   ///< [tree node], -1: a root
  std::vector<std::array<int, 2>> children;  ///< [tree node], -1: a leaf, which has neither
  std::vector<std::uint32_t> leafOfVertex;   ///< [vertex], tree node; the first leaf where it has no triangle

  std::size_t size() const { return names.size(); }
  bool isLeaf(std::uint32_t node) const { return children[node][0] < 0; }
  std::size_t leafCount() const;
};

/// Splits the cluster whose vertices lie farthest apart (the sum of area x squared distance to their mean)
/// until there are `leaves`: at the mean, across the direction in which they spread most. There may be fewer
/// where vertices coincide (coincident ones share a leaf), and more where more nodes have triangles.
/// O(vertices x depth); the result depends on the scene alone.
OccluderTree makeOccluderTree(const CompiledScene& scene, std::size_t leaves);

}  // namespace prelight
