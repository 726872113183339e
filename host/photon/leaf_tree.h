#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bvh/box.h"
#include "shared/density_types.h"

namespace prelight {

/// What a leaf tree sorts: a place and what it is the place of.
struct TreeItem {
  glm::vec3 position{0.0f};
  std::uint32_t index = 0;
};

/// A tree's items among all, [first, first + count).
struct TreeRange {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Balanced trees, each over its range of the items, halved at the median of the widest side until a leaf has
/// at most `leafCapacity` (Bentley 1975). Leaf j of a tree of 2^levels holds the items from leafBegin(j) to
/// leafBegin(j + 1) of the range, in the order of their indices.
struct LeafTrees {
  std::vector<device::LeafTree> trees;  ///< [tree]
  std::uint32_t nodeCount = 0;          ///< of all trees
  std::uint32_t leafCount = 0;
};

/// Sorts `items`. The outcome depends on nothing but positions and indices, whatever the number of threads;
/// items at the same place count by index.
LeafTrees makeLeafTrees(std::span<TreeItem> items, std::span<const TreeRange> ranges,
                        std::uint32_t leafCapacity);

/// Place of a leaf's first item within its tree's range; leaf: 0..2^levels.
std::size_t leafBegin(const device::LeafTree& tree, std::size_t leaf);

/// Boxes of all nodes from those of the leaves: [node], as LeafTree counts them.
std::vector<Box> boxesOfNodes(const LeafTrees& trees, std::span<const Box> leaves);

}  // namespace prelight
