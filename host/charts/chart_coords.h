#pragma once

#include <optional>

#include "prelight/compiled_scene.h"
#include "prelight/progress.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Returns a document with automatic charts in TEXCOORD_1 of the primitives that makeCharts() finds no
/// coordinates for, with room for `size` texels along a side of the largest map. All instances of a primitive
/// have the charts of the first. Primitives that use TEXCOORD_1 for something else, or that have no diffuse
/// light, stay. Accessors that nothing uses
/// any more are left in it. None if no primitive changes. Throws Interrupted.
std::optional<GltfDocument> withChartCoords(const Scene& scene, const CompiledScene& compiled, int size,
                                            const GltfDocument& document, const Progress& progress);

}  // namespace prelight
