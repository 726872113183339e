#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/plan.h"

namespace prelight {

/// A binary tree over a scene's occluders. Its roots are the file's nodes that have triangles, in the order
/// of CompiledScene::primitives; its leaves are clusters of their vertices. Indices are in order of creation,
/// so that a parent's is below its children's.
struct OccluderTree {
  std::vector<std::string> names;  ///< [tree node], nodeNameOf() of a root; NAME/0 and NAME/1 below NAME
  std::vector<int> parent;         ///< [tree node], -1 for a root
  std::vector<std::array<int, 2>> children;  ///< [tree node], both -1 for a leaf
  /// [vertex], tree node; the first leaf for vertices without triangle.
  std::vector<std::uint32_t> leafOfVertex;

  std::size_t size() const { return names.size(); }
  bool isLeaf(std::uint32_t node) const { return children[node][0] < 0; }
  std::size_t leafCount() const;
};

/// Makes a tree by splitting the cluster with the greatest spread of vertices (the sum of area x squared
/// distance to their mean) until there are `leaves` leaves: at the mean, across the direction of greatest
/// spread. There may be fewer leaves, as coincident vertices share one, and more if more nodes have
/// triangles. Takes O(vertices x depth) time; the result depends on the scene alone.
OccluderTree makeOccluderTree(const CompiledScene& scene, std::size_t leaves);

/// A partition of the scene's vertices into occluders. A hit counts for the occluder of one of the triangle's
/// corners, chosen by the barycentric weights, since triangles may join two occluders.
struct OccluderGroups {
  std::vector<std::string> names;            ///< [occluder]
  std::vector<std::uint32_t> groupOfVertex;  ///< [vertex]
};

/// Makes the occluders of a kind other than Auto.
OccluderGroups makeOccluderGroups(const CompiledScene& scene, OccluderKind kind);

/// Returns the leaves of a tree as occluders, in ascending order, with their names.
OccluderGroups leavesOf(const OccluderTree& tree);

/// Returns the tree nodes of the leaves, [occluder of leavesOf].
std::vector<std::uint32_t> leafNodes(const OccluderTree& tree);

}  // namespace prelight
