#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bvh/binary_bvh.h"
#include "bvh/object_split.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// The price of a leaf, according to how the layout tests its triangles.
enum class LeafPrice : std::uint8_t { Blocks, Triangles };

/// Options of buildTopDown().
struct TopDownOptions {
  bool fine = true;  ///< 32 bins per axis, otherwise 16; 8 for small ranges
  LeafPrice price = LeafPrice::Blocks;
  /// Ranges of at most this many references become leaves, larger ones never; 1..8.
  std::uint32_t leafSize = 8;
  double splitBudget = 0.0;  ///< references that spatial splits may add, as a share of the triangles
  std::size_t threads = 1;
  std::span<const std::uint32_t> triangles = {};  ///< triangles in the tree; empty: all
};

/// Returns a reference for each of `triangles`, or for each of the scene's if that is empty, in their order.
std::vector<Reference> makeReferences(const CompiledScene& scene, std::size_t threads,
                                      std::span<const std::uint32_t> triangles = {});

/// Builds a tree by binned SAH from the root down (Wald 2007), with spatial splits where object splits
/// overlap (Stich 2009). The tree depends on the scene and on all options except `threads`. The scene must
/// have a triangle.
BinaryBvh buildTopDown(const CompiledScene& scene, const TopDownOptions& options);

/// Builds a tree over boxes that are not those of triangles: triangleOrder holds indices of boxes. There are
/// no spatial splits, whatever the options say. There must be a box.
BinaryBvh buildOverBoxes(std::span<const Box> boxes, const TopDownOptions& options);

}  // namespace prelight
