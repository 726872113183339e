#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bvh/binary_bvh.h"
#include "bvh/builder.h"
#include "bvh/layouts.h"
#include "prelight/compiled_scene.h"
#include "shared/instance_types.h"

namespace prelight {

/// The contents of a tree: instances of shapes, and the scene's triangles outside them.
struct TreeContents {
  std::vector<std::uint32_t> instances;  ///< indices into CompiledScene::instances
  std::vector<std::uint32_t> triangles;
};

/// Divides `triangles`, ascending, or all of the scene's if that is empty, into `instances` all of whose
/// triangles are among them, and the other triangles.
TreeContents divideContents(const CompiledScene& scene, std::span<const std::uint32_t> instances,
                            std::span<const std::uint32_t> triangles);

/// A part of the tree in the scene's space to which a leaf of the upper level refers.
struct UpperChild {
  Box box;
  std::uint32_t child = 0;  ///< child reference, as in nodes
};

/// The data for rebuilding the tree over instances when they have moved.
struct UpperLevel {
  std::vector<std::uint32_t> instances;  ///< indices into CompiledScene::instances
  std::vector<std::uint32_t> roots;      ///< [instance] root of its shape's tree
  std::vector<UpperChild> others;        ///< parts that contain the triangles outside instances
  std::uint32_t nodeCount = 0;           ///< greatest number of nodes of the tree over the instances
  /// Greatest number of stack entries that a traversal of the trees below it needs.
  std::uint32_t lowerStackSize = 0;
};

/// A tree with instances. Its first nodes are those of the upper level.
template <typename Bvh>
struct TwoLevelBvh {
  Bvh bvh;
  std::vector<device::DeviceInstance> instances;
  UpperLevel upper;
};

/// Builds a two-level tree; the contents must have an instance. Bvh: WideBvh or NarrowBvh.
template <typename Bvh>
TwoLevelBvh<Bvh> buildTwoLevel(const CompiledScene& scene, const TreeContents& contents,
                               const BvhOptions& options);

/// Returns the upper level for the present transforms of the instances: its nodes, at most
/// UpperLevel::nodeCount, no leaves, and the stack size of a traversal of the entire tree. Boxes of instances
/// are enlarged by 2^-20 of the scene's largest coordinate, for rays that start no farther out: transforming
/// them to a shape's space moves them by less.
template <typename Bvh>
Bvh buildUpperLevel(const CompiledScene& scene, const UpperLevel& upper);

/// Returns [instance of the upper level] the records for their present transforms.
std::vector<device::DeviceInstance> instanceRecords(const CompiledScene& scene, const UpperLevel& upper);

}  // namespace prelight
