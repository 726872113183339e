#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "scene/compiled_scene.h"

namespace prelight {

/// A partition of the scene's vertices into occluders. What a ray meets counts for the occluder of a corner
/// of the triangle, chosen by the barycentric weights: triangles may join two.
struct OccluderGroups {
  std::vector<std::string> names;            ///< [occluder]
  std::vector<std::uint32_t> groupOfVertex;  ///< [vertex]
};

OccluderGroups makeOccluderGroups(const CompiledScene& scene, OccluderKind kind);

}  // namespace prelight
