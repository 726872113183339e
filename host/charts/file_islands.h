#pragma once

#include <string>
#include <vector>

#include "charts/light_map_charts.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Replaces a primitive's charts by the islands of its TEXCOORD_1 where these serve as well: they lie within
/// 0..1, do not overlap, stretch little within an island, and cut the surface along hardly more edges than
/// the charts do. Each island is flattened separately. The size of a texture unit in metres does not matter,
/// nor whether it is equal along both axes, because the mean stretch of an island is removed.
/// `charts.replaced` lists the reasons for primitives whose coordinates do not serve.
void preferFileIslands(const Scene& scene, const CompiledScene& compiled, LightMapCharts& charts);

/// Returns a text that lists whose coordinates are not used and why; empty where `replaced` is.
std::string replacedText(const std::vector<ReplacedCoords>& replaced);

/// Returns the length of the edges at which a chart ends, m.
double cutLength(const LightMapChart& chart);

}  // namespace prelight
