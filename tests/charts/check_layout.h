#pragma once

#include <string>

#include "charts/light_map_charts.h"
#include "prelight/compiled_scene.h"
#include "prelight/light_map.h"

namespace prelight::test {

/// Properties of a layout, beyond what checkLayout demands of every layout.
struct LayoutFigures {
  double used = 0.0;  ///< Share of the atlas' texels that look-ups can meet.
  /// Least ratio, over faces, of texels per square metre to the number that the texel size asks for.
  double leastRatio = 1e9;
  /// Greatest such ratio. Both ratios count charts of more than four texels across both ways.
  double mostRatio = 0.0;
  double stretched = 0.0;  ///< Share of the surface with a ratio outside 1/2 to 2; small charts count.
};

/// Expects that corners are finite and within the map; that a bilinear look-up anywhere on a face meets only
/// texels of that face's chart, all of them with a place; that every texel's place is the one at its centre,
/// or the nearest of its chart; and that the texels are sorted. `texelSize` is in metres.
LayoutFigures checkLayout(const CompiledScene& scene, const LightMapLayout& layout, double texelSize,
                          const std::string& name);

}  // namespace prelight::test
