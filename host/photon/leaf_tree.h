#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bvh/binary_bvh.h"
#include "shared/density_types.h"

namespace prelight {

/// An item of a leaf tree: a place with an index.
struct TreeItem {
  glm::vec3 position{0.0f};
  std::uint32_t index = 0;
};

/// Range of a tree's items, [first, first + count).
struct TreeRange {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Balanced trees, each over a range of the items, split at the median of the widest side until a leaf has at
/// most `leafCapacity` items (Bentley 1975). Leaf j of a tree of 2^levels leaves holds the items from
/// leafBegin(j) to leafBegin(j + 1) of the range, in the order of their indices.
struct LeafTrees {
  std::vector<device::LeafTree> trees;  ///< [tree]
  std::uint32_t nodeCount = 0;          ///< over all trees
  std::uint32_t leafCount = 0;
};

/// Builds trees and sorts `items` accordingly. The result depends only on positions and indices, not on the
/// number of threads; items at the same place are ordered by index.
LeafTrees makeLeafTrees(std::span<TreeItem> items, std::span<const TreeRange> ranges,
                        std::uint32_t leafCapacity);

/// Returns the index of a leaf's first item within its tree's range, for leaf 0..2^levels.
std::size_t leafBegin(const device::LeafTree& tree, std::size_t leaf);

/// Returns the boxes of all nodes, given those of the leaves, [node] as LeafTree counts them.
std::vector<Box> boxesOfNodes(const LeafTrees& trees, std::span<const Box> leaves);

}  // namespace prelight
