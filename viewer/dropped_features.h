#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/error.h"
#include "prelight/scene.h"
#include "viewer/shading.h"

namespace prelight::viewer {

/// Notes what of the materials of a scene's triangles a shading leaves out, a note a feature with the
/// materials' names.
void noteDroppedFeatures(const Scene& scene, const CompiledScene& compiled, Shading shading, Warnings& notes);

}  // namespace prelight::viewer
