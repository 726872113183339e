#include "photon/leaf_tree.h"

#include <algorithm>
#include <cassert>

#include "base/parallel.h"

namespace prelight {

namespace {

using device::LeafTree;

/// A node to be split, in parallel with others.
struct Halving {
  std::span<TreeItem> items;
  std::size_t middle = 0;
};

int widestSide(std::span<const TreeItem> items) {
  Box box;
  for (const TreeItem& item : items) box.grow(item.position);
  const glm::vec3 size = box.upper - box.lower;
  const int first = size.x >= size.y ? 0 : 1;
  return size[first] >= size.z ? first : 2;
}

void halve(const Halving& halving) {
  const int side = widestSide(halving.items);
  const auto before = [side](const TreeItem& a, const TreeItem& b) {
    return a.position[side] != b.position[side] ? a.position[side] < b.position[side] : a.index < b.index;
  };
  std::nth_element(halving.items.begin(), halving.items.begin() + static_cast<std::ptrdiff_t>(halving.middle),
                   halving.items.end(), before);
}

std::uint32_t levelsFor(std::size_t count, std::uint32_t leafCapacity) {
  std::uint32_t levels = 0;
  while ((std::size_t{leafCapacity} << levels) < count) ++levels;
  return levels;
}

std::size_t nodeBegin(std::size_t count, std::size_t node, std::uint32_t level) {
  return count * node >> level;
}

/// Splits the nodes of one level of a tree over `items`.
void halveLevel(std::span<TreeItem> items, std::uint32_t level) {
  parallelRanges(std::size_t{1} << level, 1 + (std::size_t{1} << level) / 64,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t node = begin; node < end; ++node) {
                     const std::size_t first = nodeBegin(items.size(), node, level);
                     const std::size_t last = nodeBegin(items.size(), node + 1, level);
                     const std::size_t middle = nodeBegin(items.size(), 2 * node + 1, level + 1);
                     halve({items.subspan(first, last - first), middle - first});
                   }
                 });
}

/// Splits a node and all nodes below it.
void halveBelow(std::span<TreeItem> items, const LeafTree& tree, std::size_t node, std::uint32_t level) {
  if (level == tree.levels) {
    const std::size_t first = leafBegin(tree, node), last = leafBegin(tree, node + 1);
    std::sort(items.begin() + static_cast<std::ptrdiff_t>(first),
              items.begin() + static_cast<std::ptrdiff_t>(last),
              [](const TreeItem& a, const TreeItem& b) { return a.index < b.index; });
    return;
  }
  const std::size_t first = nodeBegin(items.size(), node, level);
  const std::size_t last = nodeBegin(items.size(), node + 1, level);
  const std::size_t middle = nodeBegin(items.size(), 2 * node + 1, level + 1);
  halve({items.subspan(first, last - first), middle - first});
  halveBelow(items, tree, 2 * node, level + 1);
  halveBelow(items, tree, 2 * node + 1, level + 1);
}

/// Large trees are split level by level until there is work for all threads; each small tree is built by one
/// thread.
constexpr std::size_t largeTree = 1u << 14;
constexpr std::uint32_t sharedLevels = 6;

}  // namespace

std::size_t leafBegin(const LeafTree& tree, std::size_t leaf) {
  return nodeBegin(tree.count, leaf, tree.levels);
}

LeafTrees makeLeafTrees(std::span<TreeItem> items, std::span<const TreeRange> ranges,
                        std::uint32_t leafCapacity) {
  LeafTrees made;
  for (const TreeRange& range : ranges) {
    const std::uint32_t levels = levelsFor(range.count, leafCapacity);
    made.trees.push_back({made.nodeCount, made.leafCount, levels, static_cast<std::uint32_t>(range.count)});
    if (range.count == 0) continue;
    made.nodeCount += (2u << levels) - 1u;
    made.leafCount += 1u << levels;
  }
  const auto itemsOf = [&](std::size_t t) { return items.subspan(ranges[t].first, ranges[t].count); };
  parallelRanges(ranges.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      if (ranges[t].count > 0 && ranges[t].count < largeTree) halveBelow(itemsOf(t), made.trees[t], 0, 0);
  });
  for (std::size_t t = 0; t < ranges.size(); ++t) {
    if (ranges[t].count < largeTree) continue;
    for (std::uint32_t level = 0; level < sharedLevels; ++level) halveLevel(itemsOf(t), level);
    parallelRanges(std::size_t{1} << sharedLevels, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t node = begin; node < end; ++node)
        halveBelow(itemsOf(t), made.trees[t], node, sharedLevels);
    });
  }
  return made;
}

std::vector<Box> boxesOfNodes(const LeafTrees& trees, std::span<const Box> leaves) {
  std::vector<Box> boxes(trees.nodeCount);
  parallelRanges(trees.trees.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const LeafTree& tree = trees.trees[t];
      if (tree.count == 0) continue;
      const std::size_t leafCount = std::size_t{1} << tree.levels;
      const std::span<Box> nodes(boxes.data() + tree.firstNode, 2 * leafCount - 1);
      std::copy_n(leaves.begin() + tree.firstLeaf, leafCount,
                  nodes.begin() + static_cast<std::ptrdiff_t>(leafCount) - 1);
      for (std::size_t node = leafCount - 1; node > 0; --node)
        nodes[node - 1] = unite(nodes[2 * node - 1], nodes[2 * node]);
    }
  });
  return boxes;
}

}  // namespace prelight
