#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "prelight/compiled_scene.h"
#include "prelight/transfer.h"

namespace prelight {

/// The vertices that the occluders of a transfer consist of. Vertices of a leaf belong to all occluders above
/// it.
struct OccluderMembers {
  std::vector<std::uint32_t> leafOfVertex;  ///< [vertex], leaf occluder
  std::vector<int> parent;  ///< [occluder], the occluder that contains it, which has a lower index, or -1
};

/// Returns the members of a transfer's occluders for any kind of occluders that the bake had, or nothing if
/// their names do not match the scene.
std::optional<OccluderMembers> membersOf(const CompiledScene& scene, const OccluderTransfer& transfer);

/// An occluder as a ball, for views of it that no record describes.
struct OccluderBody {
  glm::dvec3 centre{0.0};        ///< mean of its surface, world space
  double reach = 0.0;            ///< from the centre to the farthest vertex, m
  double radius = 0.0;           ///< radius of the ball that covers as much of the vertices' hemispheres, m
  double accessibility = 0.0;    ///< mean AO of its visible parts
  glm::vec3 color{0.0f};         ///< mean colour of its visible parts
  glm::vec3 transmissive{0.0f};  ///< mean transmitted colour; black where not stored
};

/// Returns the bodies of the transfer's occluders, [occluder]. The transfer must hold occlusion, diffuse
/// normals and colours. Takes O(records) time.
std::vector<OccluderBody> bodiesOf(const CompiledScene& scene, const OccluderTransfer& transfer,
                                   const OccluderMembers& members);

}  // namespace prelight
