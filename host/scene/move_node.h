#pragma once

#include <glm/glm.hpp>

#include "prelight/scene.h"

namespace prelight {

/// Moves a node of a posed scene with its mesh by a way, m, in world space, after a turn about the vertical
/// through its origin: radians, counter-clockwise seen from above. What hangs on the node stays.
void moveNode(const Scene& scene, MeshNode& node, const glm::dvec3& by, double turn);

}  // namespace prelight
