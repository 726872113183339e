#pragma once

#include "bvh/binary_bvh.h"

namespace prelight {

/// Costs of traversal steps in any unit: a leaf costs `leaf` plus `triangle` per triangle.
struct TraversalCosts {
  double node = 1.0;
  double leaf = 0.0;
  double triangle = 0.0;
  std::uint32_t mostTriangles = BinaryBvh::maxLeafSize;  ///< per leaf

  double ofLeaf(std::uint32_t triangles) const { return leaf + triangle * triangles; }
};

/// Chooses leaves and eight-wide nodes together, by dynamic programming over the binary tree (Ylitie, Karras
/// and Laine 2017, section 3): of all ways to cut it, the one with the least expected cost of a ray. Subtrees
/// of few enough triangles may become leaves, and inner nodes that are wide nodes are marked `wideRoot`; the
/// root always is one unless it is a leaf. Returns a compact tree that lists each triangle once per leaf.
BinaryBvh collapseToWide(const BinaryBvh& bvh, const TraversalCosts& costs, std::size_t threads);

/// Chooses only leaves: a subtree of at most eight triangles becomes one where that is cheaper.
BinaryBvh collapseLeaves(const BinaryBvh& bvh, const TraversalCosts& costs, std::size_t threads);

}  // namespace prelight
