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

/// Light of the texels of a layout, as a map of it has, found twice, each time with noise of its own.
struct PilotLight {
  std::array<std::vector<float>, 2> irradiance;  ///< W/m2, [texel][channel]
  std::vector<std::uint8_t> hidden;              ///< [texel]: 1 inside an object
  std::uint64_t rays = 0;                        ///< that it took
};

using PilotSource = std::function<PilotLight(const LightMapLayout&)>;

struct TexelSizeRequest {
  static constexpr double darkestMean =
      0.05;  ///< that a chart's error is relative to, of the scene's mean light

  double error = 0.02;  ///< between light that is looked up and light itself: rms over a chart, in shares of
                        ///< the chart's mean light, or of a twentieth of the scene's where that is more
  double finest = 0.0;  ///< m, > 0: no texel is smaller
};

struct TexelSizes {
  std::vector<double> sizes;   ///< [chart], m
  std::vector<double> errors;  ///< [chart], as expected; 0 of charts that are not judged
  std::uint32_t specks = 0;    ///< charts too small to be judged: they have LightMapCharts::texelSize
  std::uint32_t limited = 0;   ///< charts that would need smaller texels than the finest
  std::uint64_t rays = 0;      ///< of the pilots
};

TexelSizeReport reportOf(const TexelSizes& sizes, const LightMapCharts& charts);

/// For each chart the largest texels that keep its error, by halves of an octave. A pilot map of the chart is
/// compared with coarser ones that are made of it; the error of one is the mean product of what two pilots
/// tell of it, to which their noise adds nothing. Charts whose texels must be smaller have a pilot of half
/// the size, and so on. Throws UsageError as layOutLightMap() and Interrupted.
TexelSizes chooseTexelSizes(const CompiledScene& scene, const LightMapCharts& charts,
                            const TexelSizeRequest& request, const PilotSource& light, Progress& progress);

}  // namespace prelight
