#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "benchmarks/peers/embree/ray_peer.h"
#include "benchmarks/run/measure.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"
#include "receivers/surface_sampler.h"

namespace prelight::benchmarks {

/// Values found twice by independent paths, so that their noise does not count as an error of the compared
/// values: [point][column].
struct TwiceFound {
  std::vector<double> first, second;
};

/// Accessibility, and SH transfer of order 3 with one bounce, at points spread evenly over the surface's
/// area. They are found by paths of two rays, without interpolation.
struct SurfaceTruth {
  std::vector<SurfaceSample> places;
  TwiceFound accessibility;  ///< a column
  TwiceFound transfer;       ///< [3][9] columns
};

/// Traces `side` x `side` paths per point, twice. Albedos are those of materials, without textures. Throws
/// Interrupted.
SurfaceTruth findSurfaceTruth(const CompiledScene& scene, RayPeer& rays, std::size_t places,
                              std::uint32_t side, const Progress& progress);

/// Root mean squares over the surface's area.
struct SurfaceError {
  double error = 0.0;  ///< rms error of values interpolated between vertices
  double size = 0.0;   ///< rms of the truth
};

/// Returns the error of values [vertex][column], which have the truth's columns.
SurfaceError surfaceError(const CompiledScene& scene, const std::vector<SurfaceSample>& places,
                          const TwiceFound& truth, std::span<const float> values);

/// Seconds until an error has come down to a value.
struct TimeToError {
  enum class Kind : std::uint8_t { Measured, AtMost, AtLeast };
  double seconds = 0.0;
  Kind kind = Kind::Measured;
};

/// Returns the seconds x at which a curve of errors y reaches `error`, by power laws between its points. The
/// curve is ascending in x and not empty. The result is an upper bound if the first point is good enough
/// already, a lower bound if no point is.
TimeToError timeToError(std::span<const Point> curve, double error);

}  // namespace prelight::benchmarks
