#pragma once

#include <cstdint>
#include <span>

#include "base/parallel.h"
#include "bvh/binary_bvh.h"
#include "prelight/compiled_scene.h"

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

/// The trade-off between build time and tracing speed of a tree; docs/notes/bvh.md has the numbers.
enum class BuildQuality : std::uint8_t {
  Fast,      ///< for scenes that are edited: sorted along a space-filling curve (Lauterbach 2009)
  Balanced,  ///< from the top down by the surface area heuristic
  High,      ///< for bakes: with spatial splits, which let triangles be in several leaves
};

/// The layout for which a tree is made, which determines the cost of leaves and whether eight-wide nodes are
/// chosen.
enum class BvhTarget : std::uint8_t { Wide, Narrow };

/// Options of buildBvh().
struct BvhOptions {
  BuildQuality quality = BuildQuality::High;
  BvhTarget target = BvhTarget::Wide;
  std::size_t threads = hardwareThreads();  ///< the tree does not depend on it
  /// Triangles of the scene in the tree, each once; empty: all. Their indices are the scene's. A tree of only
  /// some triangles is built from the top down at every quality.
  std::span<const std::uint32_t> triangles = {};
};

/// Builds a tree whose depth is at most BinaryBvh::maxDepth. It depends only on scene, quality and target.
/// The scene must have a triangle; positions must be finite.
BinaryBvh buildBvh(const CompiledScene& scene, const BvhOptions& options = {});

}  // namespace prelight
