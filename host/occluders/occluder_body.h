#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"

namespace prelight {

/// Which vertices the occluders of a transfer are made of: those of a leaf belong to all occluders above it.
struct OccluderMembers {
  std::vector<std::uint32_t> leafOfVertex;  ///< [vertex], an occluder
  std::vector<int> parent;                  ///< [occluder], that it is a part of; below it, or -1
};

/// The members of occluders that a bake of the scene named, whatever --occluders it had; none where the names
/// are no bake's of it.
std::optional<OccluderMembers> membersOf(const CompiledScene& scene, const OccluderTransfer& transfer);

/// An occluder where it is not known how a vertex sees it: a ball.
struct OccluderBody {
  glm::dvec3 centre{0.0};        ///< mean of its surface, world space
  double reach = 0.0;            ///< from there to its farthest vertex, m
  double radius = 0.0;           ///< of the ball that hides as much of vertices' skies as it does, m
  double accessibility = 0.0;    ///< mean AO of what vertices see of it
  glm::vec3 color{0.0f};         ///< mean of what they see
  glm::vec3 transmissive{0.0f};  ///< the same; black where it is not stored
};

/// [occluder] of the transfer, which must hold occlusion, diffuse normals and colours. O(records).
std::vector<OccluderBody> bodiesOf(const CompiledScene& scene, const OccluderTransfer& transfer,
                                   const OccluderMembers& members);

}  // namespace prelight
