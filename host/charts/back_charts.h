#pragma once

#include <cstdint>
#include <span>

#include "charts/light_map_charts.h"
#include "prelight/light_map.h"

namespace prelight {

/// Adds charts of the backs of one-sided surfaces to the layout of `charts`: of every chart that has a
/// triangle which `met`, [triangle] or empty, marks. They have the fronts' shapes and texels and lie in rows
/// of their own below what is there, which stays as it is. Returns how many were added. Throws as
/// layOutLightMap().
std::uint32_t addBacks(const CompiledScene& scene, const LightMapCharts& charts,
                       std::span<const std::uint8_t> met, LightMapLayout& layout);

}  // namespace prelight
