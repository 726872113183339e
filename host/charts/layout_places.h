#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Finds charts and texels of a layout whose width, height and corners are known, and whose chartOf
/// distinguishes noChart from any other value: faces that share a corner's place belong to one chart.
void findChartsAndTexels(const CompiledScene& scene, LightMapLayout& layout);

}  // namespace prelight
