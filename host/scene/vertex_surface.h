#pragma once

#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// Returns [vertex] a third of the area of the vertex' triangles, m2: the surface that the vertex represents.
std::vector<double> surfaceOfVertices(const CompiledScene& scene);

/// As surfaceOfVertices, with a tiny positive value for vertices without surface, so that all can be used as
/// weights.
std::vector<double> positiveSurfaceOfVertices(const CompiledScene& scene);

}  // namespace prelight
