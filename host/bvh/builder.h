#pragma once

#include <cstdint>
#include <span>

#include "base/parallel.h"
#include "bvh/binary_bvh.h"
#include "prelight/compiled_scene.h"

namespace prelight {

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

/// Fits the boxes of a tree to the present positions of the scene's triangles, without changing its
/// structure. The scene must have the triangles from which the tree was built, at any positions.
void refitBvh(BinaryBvh& bvh, const CompiledScene& scene);

}  // namespace prelight
