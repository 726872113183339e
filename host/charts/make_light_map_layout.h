#pragma once

#include <span>

#include "charts/light_map_charts.h"
#include "prelight/light_map.h"

namespace prelight {

/// Packs charts into one light map. `texelSizes`: [chart], m; empty: charts.texelSize for all. Every chart
/// has a rectangle of its own shape of texels, which look-ups of no other chart meet; where a chart is two
/// texels or more across, its size is rounded so that its outer texels have their centres on its edge. A
/// chart of less than half a texel is one texel, whose centre all its corners are at. Texels whose centre is
/// off the chart stand for the nearest place on it. Throws UsageError when more than mostLightMapSide a side
/// are needed.
LightMapLayout layOutLightMap(const CompiledScene& scene, const LightMapCharts& charts,
                              std::span<const double> texelSizes = {});

/// Throws UsageError: texels of `size` m need more than mostLightMapSide per side. `least`: a size that fits,
/// m.
[[noreturn]] void refuseTexelSize(double size, double least);

/// Charts and layout together.
LightMapLayout makeLightMapLayout(const Scene& scene, const CompiledScene& compiled,
                                  const LightMapLayoutRequest& request);

}  // namespace prelight
