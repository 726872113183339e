#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/hemisphere_renderer.h"

namespace prelight::reference {

/// Returns what a place sees, by side x side directions that are even in the projected solid angle, in double
/// precision and without an acceleration structure. Surfaces have no holes.
HemisphereView viewOf(const CompiledScene& scene, const HemispherePlace& place, int order, int side);

}  // namespace prelight::reference
