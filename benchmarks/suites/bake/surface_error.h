#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "benchmarks/peers/embree/ray_peer.h"
#include "benchmarks/run/line_fit.h"
#include "prelight/compiled_scene.h"
#include "prelight/progress.h"
#include "receivers/surface_sampler.h"

namespace prelight::benchmarks {

/// Values found twice, by independent paths, so that their noise does not count as error of what is
/// compared: [place][column].
struct TwiceFound {
  std::vector<double> first, second;
};

/// Accessibility, and SH transfer of order 3 with one bounce, at places spread evenly over the surface's
/// area. Found there by paths of two rays: nothing is interpolated.
struct SurfaceTruth {
  std::vector<SurfaceSample> places;
  TwiceFound accessibility;  ///< a column
  TwiceFound transfer;       ///< [3][9] columns
};

/// `side` x `side` paths a place, twice. Albedo is that of materials, without textures. Throws Interrupted.
SurfaceTruth findSurfaceTruth(const CompiledScene& scene, RayPeer& rays, std::size_t places,
                              std::uint32_t side, const Progress& progress);

/// Root mean squares over the surface's area.
struct SurfaceError {
  double error = 0.0;  ///< rms error of values interpolated between vertices
  double size = 0.0;   ///< rms of the truth
};

/// Error of values [vertex][column] that have the truth's columns.
SurfaceError surfaceError(const CompiledScene& scene, const std::vector<SurfaceSample>& places,
                          const TwiceFound& truth, std::span<const float> values);

/// Seconds after which something comes down to an error.
struct TimeToError {
  enum class Kind : std::uint8_t { Measured, AtMost, AtLeast };
  double seconds = 0.0;
  Kind kind = Kind::Measured;
};

/// Of errors y after x seconds, ascending in x, at least one point: between points by power laws; at most the
/// first one's seconds where that is as good already, at least the last one's where none is.
TimeToError timeToError(std::span<const Point> curve, double error);

}  // namespace prelight::benchmarks
