#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Finds charts and texels of a layout of which width, height and corners are known, and chartOf as far as it
/// tells noChart from any other: faces that share a corner's place are of one chart.
void findChartsAndTexels(const CompiledScene& scene, LightMapLayout& layout);

}  // namespace prelight
