#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"
#include "viewer/scene/triangle_blocks.h"

namespace prelight::viewer {

/// A body whose inside would be seen by an eye within it: of two-sided surfaces.
struct TwoSidedBody {
  int node = -1;
  std::vector<TriangleRange> triangles;
  glm::vec3 lower{3e38f}, upper{-3e38f};  ///< bounds, scene coordinates
};

/// Whether a point lies within a closed surface: most of three rays from it meet an odd number of triangles.
bool liesWithin(const CompiledScene& scene, const TwoSidedBody& body, const glm::vec3& point);

/// Where an eye is to stand that looks around a node: at `center`, unless that lies within a body that parts
/// of the node stick out of; then in the middle of those parts, or on one of them. `own` are the node's
/// triangles. What lies within a body as a whole (in a room) keeps its centre.
glm::vec3 placeOutside(const CompiledScene& scene, const std::vector<TriangleRange>& own,
                       const glm::vec3& center, const std::vector<TwoSidedBody>& bodies);

}  // namespace prelight::viewer
