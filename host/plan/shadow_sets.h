#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/plan.h"

namespace prelight {

/// Which triangles the receivers of each node see (Staniszewski 3.1). What a receiver does not see is not
/// there for it: it neither hides the sky, nor reflects, nor shines by its surface. Punctual lights always
/// shine.
struct ShadowSets {
  /// What the receivers of some nodes see, when it is not everything.
  struct Occluders {
    std::vector<std::uint32_t> triangles;  ///< ascending; empty: nothing shadows them
    std::uint32_t nodes = 0;               ///< that are seen
    std::uint32_t receivers = 0;           ///< nodes that see no more than this
  };
  std::vector<Occluders> sets;               ///< set s is sets[s - 1]; set 0 is the whole scene
  std::vector<std::uint32_t> setOfTriangle;  ///< [triangle], of the receivers on it; empty: all 0

  bool empty() const { return sets.empty(); }
  std::uint32_t setOf(std::uint32_t triangle) const {
    return setOfTriangle.empty() ? 0 : setOfTriangle[triangle];
  }
  std::uint64_t treeTriangles() const;
  std::vector<std::uint32_t> setOfVertices(const CompiledScene& scene) const;
};

/// Name of a primitive's node as patterns see it: "node I" where it has none.
std::string nodeNameOf(const PrimitiveRange& range);

/// A node in several requests' receivers sees what any of them lets it see; in none, everything. Nodes that
/// see the same share a set. Throws UsageError for a pattern that no node with a mesh matches.
ShadowSets makeShadowSets(const CompiledScene& scene, const std::vector<ShadowSetRequest>& requests);

}  // namespace prelight
