#pragma once

#include <cstdint>

#include "benchmarks/measure.h"
#include "benchmarks/picture_error.h"
#include "benchmarks/suite.h"
#include "integrators/reference.h"
#include "viewer/core/shading.h"

namespace prelight::benchmarks {

/// A sky of two lobes, which SH of order 3 hold exactly; radiance below 1.
Environment makeLobedSky(int rows);

/// Path traced from the scene's first camera, under a sky alone, or without one by the scene's own lights.
Picture tracedPicture(const BenchmarkScene& scene, const Environment* sky,
                      const reference::ReferenceRequest& request, const Device& device,
                      const Progress& progress);

/// How far a picture is from the truth, and what it took.
struct SkyPicture {
  MeasuredError error;   ///< of the truth's rms
  double seconds = 0.0;  ///< of all processors, bake and picture
  std::uint64_t rays = 0;
};

/// A scene under a sky alone, path traced twice with samples of their own; pictures of it are compared with
/// these. Needs a current OpenGL context; the arguments outlive it.
class SkyTrial {
 public:
  SkyTrial(const BenchmarkScene& scene, const Environment& sky, const BenchmarkOptions& options,
           const Device& device, const Progress& progress);

  /// Of a bake, drawn.
  SkyPicture draw(const BakeRequest& request, viewer::Shading shading) const;

  /// Of a path tracer of its own samples.
  SkyPicture trace(std::uint64_t samples) const;

 private:
  Picture traced(std::uint64_t samples, std::uint64_t seed) const;
  MeasuredError errorOf(const Picture& picture) const;

  const BenchmarkScene& scene_;
  const Environment& sky_;
  const BenchmarkOptions& options_;
  const Device& device_;
  const Progress& progress_;
  Picture first_, second_;
  double size_ = 0.0;  ///< rms of the truth
};

}  // namespace prelight::benchmarks
