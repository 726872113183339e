#pragma once

#include <cstdint>
#include <span>

#include "charts/light_map_charts.h"
#include "prelight/light_map.h"

namespace prelight {

/// Adds charts of the backs of one-sided surfaces to the layout of `charts`: for every chart with a triangle
/// that `met`, [triangle] or empty, marks. They have the shapes and texels of the fronts and lie in rows of
/// their own below the existing ones, which are unchanged. Returns the number of charts added. Throws as
/// layOutLightMap().
std::uint32_t addBacks(const CompiledScene& scene, const LightMapCharts& charts,
                       std::span<const std::uint8_t> met, LightMapLayout& layout);

}  // namespace prelight
