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
  std::uint32_t stackSize = 0;  ///< greatest number of entries that a traversal needs
};

/// Two-wide tree for GPUs.
struct NarrowBvh {
  std::vector<device::NarrowNode> nodes;  ///< root is node 0
  std::vector<device::NarrowTriangle> triangles;
  std::uint32_t stackSize = 0;
};

/// Makes the wide layout, in which the nodes marked as wide roots become nodes.
WideBvh makeWideBvh(const BinaryBvh& bvh, const CompiledScene& scene);

NarrowBvh makeNarrowBvh(const BinaryBvh& bvh, const CompiledScene& scene);

/// Makes only nodes, for a tree over other trees' nodes or instances with one per leaf: `children[i]` is the
/// child reference for the i-th of these. Boxes are not enlarged.
WideBvh makeWideTop(const BinaryBvh& bvh, std::span<const std::uint32_t> children);
NarrowBvh makeNarrowTop(const BinaryBvh& bvh, std::span<const std::uint32_t> children);

}  // namespace prelight
