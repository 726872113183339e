#pragma once

#include <span>

#include "charts/light_map_charts.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight {

/// Finds charts and texels of a layout whose width, height and corners are known, and whose chartOf
/// distinguishes noChart from any other value: faces that share a corner's place belong to one chart.
void findChartsAndTexels(const CompiledScene& scene, LightMapLayout& layout);

/// Packs charts into one light map. `texelSizes`: [chart], m; empty: charts.texelSize for all. Every chart
/// occupies texels in its own shape, which look-ups in no other chart meet. If a chart is at least two texels
/// across, its size is rounded so that its outer texels have their centres on its edge. A chart of less than
/// half a texel becomes one texel with all corners at its centre. Texels whose centre is off the chart
/// represent the nearest place on it. Throws UsageError when more than mostLightMapSide texels per side are
/// needed.
LightMapLayout layOutLightMap(const CompiledScene& scene, const LightMapCharts& charts,
                              std::span<const double> texelSizes = {});

/// Throws UsageError, which says that texels of `size` m need more than mostLightMapSide per side. `least`: a
/// size that fits, m.
[[noreturn]] void refuseTexelSize(double size, double least);

/// Makes charts and lays them out.
LightMapLayout makeLightMapLayout(const Scene& scene, const CompiledScene& compiled,
                                  const LightMapLayoutRequest& request);

}  // namespace prelight
