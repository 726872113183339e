#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "charts/light_map_charts.h"
#include "prelight/bake.h"
#include "prelight/light_map.h"
#include "prelight/progress.h"

namespace prelight {

/// Light of the texels of a layout, found twice with independent noise.
struct PilotLight {
  std::array<std::vector<float>, 2> irradiance;  ///< W/m2, [texel][channel]
  std::vector<std::uint8_t> hidden;              ///< [texel]: 1 inside an object
  std::uint64_t rays = 0;                        ///< cast for it
};

using PilotSource = std::function<PilotLight(const LightMapLayout&)>;

/// Requested quality of a light map's texels.
struct TexelSizeRequest {
  static constexpr double darkestMean =
      0.05;  ///< least reference of a chart's error, as a share of the scene's mean light

  /// Error of look-ups: rms over a chart, as a share of the chart's mean light or, if that is more, of a
  /// twentieth of the scene's.
  double error = 0.02;
  double finest = 0.0;  ///< m, > 0; least texel size
};

/// The texel sizes that chooseTexelSizes() has chosen.
struct TexelSizes {
  std::vector<double> sizes;   ///< [chart], m
  std::vector<double> errors;  ///< [chart] expected errors; 0 for charts that are not judged
  std::uint32_t specks = 0;    ///< charts too small to be judged, which have LightMapCharts::texelSize
  std::uint32_t limited = 0;   ///< charts that would need smaller texels than the finest
  std::uint64_t rays = 0;      ///< rays of the pilots
};

TexelSizeReport reportOf(const TexelSizes& sizes, const LightMapCharts& charts);

/// Returns for each chart the largest texels that keep its error, in half octaves. A pilot map of the chart
/// is compared with coarser ones made from it; the error of a coarser one is the mean product of its
/// differences from two pilots, to which their noise contributes nothing. Charts whose texels must be smaller
/// get a pilot of half the size, and so on. Throws UsageError as layOutLightMap(), and Interrupted.
TexelSizes chooseTexelSizes(const CompiledScene& scene, const LightMapCharts& charts,
                            const TexelSizeRequest& request, const PilotSource& light, Progress& progress);

}  // namespace prelight
