#pragma once

#include <string>

#include "charts/light_map_charts.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight::test {

/// What a layout is like, beside what checkLayout demands of every one.
struct LayoutFigures {
  double used = 0.0;        ///< share of the atlas' texels that look-ups can meet
  double leastRatio = 1e9;  ///< texels a square metre of a face over those that the size asks for, of charts
  double mostRatio = 0.0;   ///< that are more than four texels across both ways
  double stretched = 0.0;   ///< share of the surface outside 1/2 to 2 (small charts count)
};

/// Expects that corners are finite and within the map; that a bilinear look-up anywhere on a face meets only
/// texels of that face's chart, all of them with a place; that every texel's place is the one at its centre,
/// or the nearest of its chart; and that the texels are sorted. `texelSize` in metres.
LayoutFigures checkLayout(const CompiledScene& scene, const LightMapLayout& layout, double texelSize,
                          const std::string& name);

}  // namespace prelight::test
