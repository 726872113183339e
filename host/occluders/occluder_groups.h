#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "occluders/occluder_tree.h"
#include "prelight/compiled_scene.h"
#include "prelight/plan.h"

namespace prelight {

/// A partition of the scene's vertices into occluders. What a ray meets counts for the occluder of a corner
/// of the triangle, chosen by the barycentric weights: triangles may join two.
struct OccluderGroups {
  std::vector<std::string> names;            ///< [occluder]
  std::vector<std::uint32_t> groupOfVertex;  ///< [vertex]
};

/// `kind` is not Auto.
OccluderGroups makeOccluderGroups(const CompiledScene& scene, OccluderKind kind);

/// The leaves of a tree, in ascending order; names are theirs.
OccluderGroups leavesOf(const OccluderTree& tree);

/// [occluder of leavesOf], node of the tree.
std::vector<std::uint32_t> leafNodes(const OccluderTree& tree);

}  // namespace prelight
