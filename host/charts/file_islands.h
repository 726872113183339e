#pragma once

#include <string>
#include <vector>

#include "charts/light_map_charts.h"
#include "prelight/compiled_scene.h"
#include "prelight/scene.h"

namespace prelight {

/// Puts the islands of a primitive's TEXCOORD_1 in place of its charts, where they serve as well: they lie
/// within 0..1, use no place twice, stretch little within an island, and cut the surface along hardly more
/// than the charts do. Each island is laid flat by itself. How many metres a unit of the texture is does not
/// matter, nor whether it is as many along both axes: the mean stretch of an island is undone. Of primitives
/// whose coordinates do not serve, `charts.replaced` tells why.
void preferFileIslands(const Scene& scene, const CompiledScene& compiled, LightMapCharts& charts);

/// Whose coordinates are not used and why, for people; empty where `replaced` is.
std::string replacedText(const std::vector<ReplacedCoords>& replaced);

/// The length of the edges along which a chart ends, m.
double cutLength(const LightMapChart& chart);

}  // namespace prelight
