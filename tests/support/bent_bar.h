#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/gltf/gltf_document.h"

namespace prelight::test {

/// Vertices of a bar in the plane z = 0: x is -0.5 or 0.5, y 0, 1 or 2.
std::vector<glm::vec3> barPositions();

/// The bar with normals +x, node 2, on two joints: node 0 at the origin and its child, node 1, a metre up,
/// which turns a quarter counter-clockwise about z within 1 s. Vertices at y = 0 hang on the lower joint, at
/// 2 on the upper one, those between on both by halves.
GltfDocument bentBar();

}  // namespace prelight::test
