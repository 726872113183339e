#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bvh/binary_bvh.h"
#include "bvh/builder.h"

namespace prelight {

/// What a tree is like.
struct BvhReport {
  double sahCost = 0.0;     ///< nodes and leaves (blocks) that a long random line meets, expected: surfaces
                            ///< over the root's
  std::uint32_t depth = 0;  ///< levels of the layout's nodes and leaves
  std::size_t nodes = 0;    ///< of the layout: eight-wide or two-wide
  std::size_t leaves = 0;
  double meanLeafFill = 0.0;      ///< triangles a leaf over eight
  double duplicates = 0.0;        ///< triangles named more than once, as a share of the scene's
  double bytesPerTriangle = 0.0;  ///< nodes and leaves in the device layout
  double seconds = 0.0;           ///< of the build
};

BvhReport reportOf(const BinaryBvh& bvh, std::size_t sceneTriangles, BvhTarget target = BvhTarget::Wide);

/// What a tree of two levels is like, in the wide layout.
struct TwoLevelReport {
  std::size_t instances = 0;
  std::size_t nodes = 0;  ///< of all shapes, of what is in none and of the tree over these
  std::size_t leaves = 0;
  std::size_t bytes = 0;  ///< nodes, leaves and instances in the device layout
  double seconds = 0.0;   ///< of the build
};

/// `instances` into CompiledScene::instances, at least one.
TwoLevelReport reportTwoLevel(const CompiledScene& scene, std::span<const std::uint32_t> instances);

}  // namespace prelight
