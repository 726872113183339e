#pragma once

#include <cstddef>

#include "prelight/compiled_scene.h"
#include "prelight/scene.h"
#include "scene/gltf/gltf_document.h"

namespace prelight {

/// Writes automatic charts into TEXCOORD_1 of the document's primitives that makeCharts() finds no
/// coordinates for, with room for `size` texels along a side of the largest map. All drawings of a primitive
/// have the charts of the first. Returns the number of primitives that changed; those whose materials use
/// TEXCOORD_1, or that have no diffuse light, do not.
std::size_t writeChartCoords(const Scene& scene, const CompiledScene& compiled, int size,
                             GltfDocument& document);

}  // namespace prelight
