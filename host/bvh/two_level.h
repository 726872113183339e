#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bvh/box.h"
#include "bvh/builder.h"
#include "bvh/layouts.h"
#include "prelight/compiled_scene.h"
#include "shared/instance_types.h"

namespace prelight {

/// What a tree holds: instances of shapes, and triangles of the scene that are in none of them.
struct TreeContents {
  std::vector<std::uint32_t> instances;  ///< into CompiledScene::instances
  std::vector<std::uint32_t> triangles;
};

/// Divides `triangles`, ascending, or all of the scene's when there are none, into those of `instances` that
/// lie among them as a whole, and the others.
TreeContents divideContents(const CompiledScene& scene, std::span<const std::uint32_t> instances,
                            std::span<const std::uint32_t> triangles);

/// A part of the tree in the scene's space that a leaf of the upper level leads to.
struct UpperChild {
  Box box;
  std::uint32_t child = 0;  ///< as nodes name their children
};

/// What is needed to make the tree over instances anew when they have moved.
struct UpperLevel {
  std::vector<std::uint32_t> instances;  ///< into CompiledScene::instances
  std::vector<std::uint32_t> roots;      ///< [instance], of its shape's tree
  std::vector<UpperChild> others;        ///< they hold the triangles that are in no instance
  std::uint32_t nodeCount = 0;           ///< what the tree over the instances may take at most
  std::uint32_t lowerStackSize = 0;      ///< entries that a traversal of the trees below it needs at most
};

/// A tree with instances. The first nodes are the upper level's.
template <typename Bvh>
struct TwoLevelBvh {
  Bvh bvh;
  std::vector<device::DeviceInstance> instances;
  UpperLevel upper;
};

/// The contents must have an instance. Bvh: WideBvh or NarrowBvh.
template <typename Bvh>
TwoLevelBvh<Bvh> buildTwoLevel(const CompiledScene& scene, const TreeContents& contents,
                               const BvhOptions& options);

/// The upper level where the instances are now: its nodes, at most UpperLevel::nodeCount, no leaves, and the
/// stack of a traversal of the whole. Boxes of instances grow by 2^-20 of the scene's largest coordinate, for
/// rays that start no farther out: taking them to a shape's space moves them by less.
template <typename Bvh>
Bvh buildUpperLevel(const CompiledScene& scene, const UpperLevel& upper);

/// [instance of the upper level], where they are now.
std::vector<device::DeviceInstance> instanceRecords(const CompiledScene& scene, const UpperLevel& upper);

}  // namespace prelight
