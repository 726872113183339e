#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "benchmarks/run/measure.h"
#include "prelight/device.h"
#include "prelight/progress.h"

namespace prelight::benchmarks {

/// Light at points of a scene's surface, found twice with independent noise.
struct SurfaceLight {
  std::vector<LightMapTexel> places;
  std::vector<double> weights;              ///< [place], m2; 0 inside objects
  std::array<std::vector<float>, 2> light;  ///< irradiance, W/m2, [place][channel]
};

/// Returns the light at about `places` points with equal density, but at least some per triangle. Light is
/// that of a light map's request, with other random numbers.
SurfaceLight lightOfSurface(const BenchmarkScene& scene, std::size_t places, BakeRequest request,
                            const Device& device, Progress& progress);

/// Returns the error of a light map: the rms over the surface of the rms per chart, relative to the chart's
/// mean light, or to a twentieth of the
/// scene's if that is more. `again`: the map made with other random numbers, so that its noise does not
/// count, or the map itself.
double errorOfLightMap(const LightMap& map, const LightMap& again, const SurfaceLight& light);

}  // namespace prelight::benchmarks
