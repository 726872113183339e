#pragma once

#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"

namespace prelight {

/// Share of what surfaces would send to an object's vertices that the object's own shadow on them leaves,
/// [vertex]. Surfaces that a vertex sees are taken to be lit evenly from all around, and the object to be the
/// ball that hides as much in the mean over all directions. `walls` is the scene without objects.
std::vector<double> shareBesideOwnShadow(const CompiledScene& scene, const VertexRange& object,
                                         Tracer& walls);

}  // namespace prelight
