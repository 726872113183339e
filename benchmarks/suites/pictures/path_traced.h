#pragma once

#include <cstdint>

#include "benchmarks/run/measure.h"
#include "prelight/picture.h"

namespace prelight::benchmarks {

struct TimedPicture {
  Picture picture;
  double seconds = 0.0;
  double reportedError = 0.0;  ///< Film::relativeError() of path tracing; 0 after a single pass
};

/// A picture by the reference renderer, of the scene's own lights and first camera: a square of `size` pixels
/// a side. `progress` is asked whether to stop but told nothing.
TimedPicture pathTrace(const BenchmarkScene& scene, int size, std::uint64_t samples, std::uint64_t seed,
                       const Device& device, const Progress& progress);

}  // namespace prelight::benchmarks
