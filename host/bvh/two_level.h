#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bvh/box.h"
#include "prelight/compiled_scene.h"
#include "shared/bvh_types.h"
#include "shared/instance_types.h"

namespace prelight {

/// A shape that stands somewhere. Its triangles are counted from `firstTriangle` on in hits.
struct Instance {
  std::uint32_t shape = 0;
  std::uint32_t firstTriangle = 0;
  glm::mat4 toWorld{1.0f};  ///< affine and invertible
};

/// Trees of shapes that instances share, one after the other in common buffers.
struct ShapeTrees {
  struct Shape {
    std::uint32_t firstNode = 0;
    std::uint32_t firstLeaf = 0;
    std::uint32_t triangleCount = 0;
    Box bounds;
  };
  std::vector<Shape> shapes;
  std::vector<device::NarrowNode> nodes;          ///< children count from the shape's first node
  std::vector<device::NarrowTriangle> triangles;  ///< in the order of leaves; indices within the shape
  std::uint32_t stackSize = 0;                    ///< entries that a traversal of any shape needs
};

/// The tree over the instances' boxes: what changes when they move.
struct InstanceTree {
  std::vector<device::NarrowNode> nodes;  ///< root is node 0; a leaf is PRELIGHT_LEAF_BIT | instance
  std::vector<device::DeviceInstance> instances;
  std::uint32_t stackSize = 0;
};

/// Each shape must have a triangle.
ShapeTrees buildShapeTrees(std::span<const CompiledScene> shapes);

/// There must be an instance. Its box in the world holds the transformed box of the shape and grows by 2^-20
/// of the largest coordinate of any instance, for rays that start no farther out: taking them to a shape's
/// space moves them by less.
/// Throws Error when an instance names no shape or its matrix has no inverse.
InstanceTree buildInstanceTree(const ShapeTrees& shapes, std::span<const Instance> instances);

}  // namespace prelight
