#pragma once

#include <cstdint>
#include <span>

#include "base/parallel.h"
#include "bvh/binary_bvh.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// How much time goes into a tree, against how fast rays are traced through it; docs/bvh.md has the numbers.
enum class BuildQuality : std::uint8_t {
  Fast,      ///< for scenes that are edited: sorted along a space-filling curve (Lauterbach 2009)
  Balanced,  ///< from the top down by the surface area heuristic
  High,      ///< for bakes: with spatial splits, which let triangles be in several leaves
};

/// Which layout a tree is made for: what its leaves cost, and whether eight-wide nodes are chosen.
enum class BvhTarget : std::uint8_t { Wide, Narrow };

struct BvhOptions {
  BuildQuality quality = BuildQuality::High;
  BvhTarget target = BvhTarget::Wide;
  std::size_t threads = hardwareThreads();  ///< the tree does not depend on it
  /// Triangles of the scene that the tree holds, each once; empty: all. Their indices stay the scene's. A
  /// tree of a part is built from the top down whatever the quality.
  std::span<const std::uint32_t> triangles = {};
};

/// Builds a tree whose depth is at most BinaryBvh::maxDepth. It depends on scene, quality and target alone.
/// The scene must have a triangle; positions must be finite.
BinaryBvh buildBvh(const CompiledScene& scene, const BvhOptions& options = {});

/// Fits the boxes of a tree to the scene's triangles where they are now; the tree stays what it was. The
/// scene must have the triangles that the tree was built from, wherever their vertices went.
void refitBvh(BinaryBvh& bvh, const CompiledScene& scene);

}  // namespace prelight
