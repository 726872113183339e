#pragma once

#include <vector>

#include "prelight/compiled_scene.h"

namespace prelight {

/// A third of the area of each vertex' triangles, m2: the surface that the vertex stands for. [vertex]
std::vector<double> surfaceOfVertices(const CompiledScene& scene);

/// The same, with next to nothing where a vertex has none, so that there is always something to weigh by.
std::vector<double> positiveSurfaceOfVertices(const CompiledScene& scene);

}  // namespace prelight
