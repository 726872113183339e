#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "benchmarks/run/measure.h"
#include "prelight/device.h"
#include "prelight/progress.h"

namespace prelight::benchmarks {

/// Light at places of a scene's surface, found twice, each time with noise of its own.
struct SurfaceLight {
  std::vector<LightMapTexel> places;
  std::vector<double> weights;              ///< [place], m2; 0 inside objects
  std::array<std::vector<float>, 2> light;  ///< irradiance, W/m2, [place][channel]
};

/// About so many places, as many a square metre everywhere, but some on every triangle, under the light of a
/// light map's request, with other random numbers.
SurfaceLight lightOfSurface(const BenchmarkScene& scene, std::size_t places, BakeRequest request,
                            const Device& device, Progress& progress);

/// Error of a light map: rms over each chart in shares of its mean light, or of a twentieth of the
/// scene's where that is more, and of that rms over the surface. `again`: the map, made with other random
/// numbers, so that its noise does not count; or the map itself.
double errorOfLightMap(const LightMap& map, const LightMap& again, const SurfaceLight& light);

}  // namespace prelight::benchmarks
