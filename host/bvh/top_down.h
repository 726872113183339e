#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bvh/binary_bvh.h"
#include "bvh/reference.h"
#include "prelight/compiled_scene.h"

namespace prelight {

/// What a leaf is priced by, as the layout tests its triangles.
enum class LeafPrice : std::uint8_t { Blocks, Triangles };

struct TopDownOptions {
  bool fine = true;  ///< 32 bins an axis, else 16; 8 for small ranges
  LeafPrice price = LeafPrice::Blocks;
  std::uint32_t leafSize = 8;  ///< ranges of at most this many references become leaves, others never; 1..8
  double splitBudget = 0.0;    ///< references that spatial splits may add, as a share of the triangles
  std::size_t threads = 1;
  std::span<const std::uint32_t> triangles = {};  ///< those that the tree holds; empty: all
};

/// A reference for each of `triangles`, or for each of the scene's when there are none, in their order.
std::vector<Reference> makeReferences(const CompiledScene& scene, std::size_t threads,
                                      std::span<const std::uint32_t> triangles = {});

/// Binned SAH from the root down (Wald 2007), with spatial splits where object splits overlap (Stich 2009).
/// The tree depends on the scene and on the options but `threads`. The scene must have a triangle.
BinaryBvh buildTopDown(const CompiledScene& scene, const TopDownOptions& options);

/// The same over boxes that are not those of triangles: triangleOrder names boxes. Without spatial splits,
/// whatever the options say. There must be a box.
BinaryBvh buildOverBoxes(std::span<const Box> boxes, const TopDownOptions& options);

}  // namespace prelight
