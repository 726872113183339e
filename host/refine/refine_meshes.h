#pragma once

#include <string>
#include <vector>

#include "gpu/tracer.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"
#include "prelight/refine.h"
#include "prelight/scene.h"
#include "refine/refined_mesh.h"

namespace prelight {

/// Subdivides the meshes of a scene until linear interpolation over each part of a triangle loses at most
/// RefineRequest::error, or the part is too small, or there are enough vertices. Level by level, parts are
/// probed and the edges of bad ones are cut. A mesh with many instances is refined for a few of them.
/// Returns the primitives that change. Throws Interrupted.
std::vector<RefinedPrimitive> refineMeshes(const Scene& scene, const CompiledScene& compiled, Tracer& tracer,
                                           const RefineRequest& request, Progress& progress,
                                           RefineReport& report);

/// Returns what a refinement has done as a sentence.
std::string textOf(const RefineReport& report);

}  // namespace prelight
