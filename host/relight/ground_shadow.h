#pragma once

#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "relight/vertex_lights.h"

namespace prelight {

/// Returns the share of the light from surfaces to an object's vertices that remains in spite of the object's
/// own shadow on these surfaces, [vertex]. Visible surfaces are assumed to be lit uniformly from all sides,
/// and the object to be a ball that hides as much on average over all directions. `walls` is the scene
/// without objects.
std::vector<double> shareBesideOwnShadow(const CompiledScene& scene, const VertexRange& object,
                                         Tracer& walls);

}  // namespace prelight
