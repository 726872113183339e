#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/plan.h"

namespace prelight {

/// The triangles that the receivers of each node see (Staniszewski 3.1). For a receiver, other triangles do
/// not exist: they neither occlude, nor reflect, nor emit. Punctual lights always shine.
struct ShadowSets {
  /// Triangles that the receivers of some nodes see, if not all.
  struct Occluders {
    std::vector<std::uint32_t> triangles;  ///< ascending; empty: nothing occludes them
    std::uint32_t nodes = 0;               ///< number of nodes that are seen
    std::uint32_t receivers = 0;           ///< number of nodes whose receivers use this set
  };
  std::vector<Occluders> sets;               ///< set s is sets[s - 1]; set 0 is the whole scene
  std::vector<std::uint32_t> setOfTriangle;  ///< [triangle], set of the receivers on it; empty: all 0

  bool empty() const { return sets.empty(); }
  std::uint32_t setOf(std::uint32_t triangle) const {
    return setOfTriangle.empty() ? 0 : setOfTriangle[triangle];
  }
  std::uint64_t treeTriangles() const;
  std::vector<std::uint32_t> setOfVertices(const CompiledScene& scene) const;
};

/// Returns the name of a primitive's node for matching patterns, "node I" if it has none.
std::string nodeNameOf(const PrimitiveRange& range);

/// Makes the sets. A node among the receivers of several requests sees what any of them permits; a node in
/// none sees everything. Nodes that see the same share a set. Throws UsageError for a pattern that no node
/// with a mesh matches.
ShadowSets makeShadowSets(const CompiledScene& scene, const std::vector<ShadowSetRequest>& requests);

}  // namespace prelight
