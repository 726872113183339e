#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "occluders/occluder_tree.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"

namespace prelight {

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
