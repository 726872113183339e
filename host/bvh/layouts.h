#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bvh/builder.h"
#include "shared/bvh_types.h"

namespace prelight {

/// Eight-wide tree for CPUs; see kernels/shared/bvh_types.h.
struct WideBvh {
  std::vector<device::WideNode> nodes;  ///< root is node 0
  std::vector<device::TriangleBlock> blocks;
  std::uint32_t stackSize = 0;  ///< entries that a traversal needs at most
};

/// Two-wide tree for GPUs.
struct NarrowBvh {
  std::vector<device::NarrowNode> nodes;  ///< root is node 0
  std::vector<device::NarrowTriangle> triangles;
  std::uint32_t stackSize = 0;
};

/// The nodes that are marked as wide roots become nodes.
WideBvh makeWideBvh(const BinaryBvh& bvh, const CompiledScene& scene);

NarrowBvh makeNarrowBvh(const BinaryBvh& bvh, const CompiledScene& scene);

/// Nodes alone, of a tree whose leaves are others' nodes or instances: one each, `children[i]` what a node
/// has for the i-th of those that the tree was built over. Boxes are taken as they are.
WideBvh makeWideTop(const BinaryBvh& bvh, std::span<const std::uint32_t> children);
NarrowBvh makeNarrowTop(const BinaryBvh& bvh, std::span<const std::uint32_t> children);

}  // namespace prelight
