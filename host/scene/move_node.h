#pragma once

#include <glm/glm.hpp>

#include "prelight/scene.h"

namespace prelight {

/// Turns a node of a posed scene, with its mesh, around the vertical through its origin by `turn` (radians,
/// counter-clockwise seen from above), then moves it by `by` (m, world space). Its child nodes stay in place.
void moveNode(const Scene& scene, MeshNode& node, const glm::dvec3& by, double turn);

}  // namespace prelight
