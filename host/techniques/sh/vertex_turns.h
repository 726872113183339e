#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns the greatest absolute difference of two entries.
double greatestDifference(const glm::dmat3& a, const glm::dmat3& b);

/// Returns the rotation nearest to the linear part of an affine map, by polar decomposition. It is the
/// identity for maps that flatten or mirror.
glm::dmat3 rotationOf(const glm::dmat4& map);

/// Returns [vertex] how the surface around each vertex has turned between two poses of a scene, whatever has
/// moved it: the rotation nearest to the linear map that takes the edges at the vertex and its normal to
/// those of the other pose with the least squares. Vertices without triangles turn with their normal alone.
std::vector<glm::dmat3> vertexTurns(const CompiledScene& from, const CompiledScene& to);

}  // namespace prelight
