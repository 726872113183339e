#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bvh/binary_bvh.h"
#include "bvh/builder.h"

namespace prelight {

/// Statistics of a tree.
struct BvhReport {
  /// Expected number of nodes and leaves (blocks) that a long random line meets: their surface areas divided
  /// by the root's.
  double sahCost = 0.0;
  std::uint32_t depth = 0;  ///< levels of the layout's nodes and leaves
  std::size_t nodes = 0;    ///< nodes of the layout, eight-wide or two-wide
  std::size_t leaves = 0;
  double meanLeafFill = 0.0;  ///< mean number of triangles per leaf, divided by eight
  /// References to triangles beyond the first, as a share of the scene's triangles.
  double duplicates = 0.0;
  double bytesPerTriangle = 0.0;  ///< nodes and leaves in the device layout
  double seconds = 0.0;           ///< build time
};

BvhReport reportOf(const BinaryBvh& bvh, std::size_t sceneTriangles, BvhTarget target = BvhTarget::Wide);

/// Statistics of a two-level tree in the wide layout.
struct TwoLevelReport {
  std::size_t instances = 0;
  std::size_t nodes = 0;  ///< nodes of all shapes, of triangles outside shapes and of the tree over these
  std::size_t leaves = 0;
  std::size_t bytes = 0;  ///< nodes, leaves and instances in the device layout
  double seconds = 0.0;   ///< build time
};

/// `instances`: indices into CompiledScene::instances, at least one.
TwoLevelReport reportTwoLevel(const CompiledScene& scene, std::span<const std::uint32_t> instances);

}  // namespace prelight
