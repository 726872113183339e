#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/gltf/gltf_document.h"

namespace prelight::test {

/// Vertices of a bar in the plane z = 0: x is -0.5 or 0.5, and y is 0, 1 or 2.
std::vector<glm::vec3> barPositions();

/// The bar as node 2, with normals +x and two joints. Joint node 0 is at the origin; its child, node 1, is a
/// metre higher and turns a quarter counter-clockwise about z within 1 s. Vertices at y = 0 follow the lower
/// joint, those at y = 2 the upper one, those at y = 1 both with equal weights.
GltfDocument bentBar();

}  // namespace prelight::test
