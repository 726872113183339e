#pragma once

#include <cstdint>

#include "benchmarks/run/measure.h"
#include "benchmarks/suites/pictures/pictures_suite.h"
#include "benchmarks/truth/picture_error.h"
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
  MeasuredError error;   ///< in shares of the truth's rms
  double seconds = 0.0;  ///< processor time of bake and picture
  std::uint64_t rays = 0;
};

/// A scene under a sky alone, path traced twice with samples of their own; pictures of it are compared with
/// these. Needs a current OpenGL context; the arguments outlive it.
class SkyTrial {
 public:
  SkyTrial(const BenchmarkScene& scene, const Environment& sky, const PicturesOptions& options,
           const Device& device, const Progress& progress);

  /// Bakes and draws.
  SkyPicture draw(const BakeRequest& request, viewer::Shading shading) const;

  /// Path traces with samples that the truths do not share.
  SkyPicture trace(std::uint64_t samples) const;

 private:
  Picture traced(std::uint64_t samples, std::uint64_t seed) const;
  MeasuredError errorOf(const Picture& picture) const;

  const BenchmarkScene& scene_;
  const Environment& sky_;
  const PicturesOptions& options_;
  const Device& device_;
  const Progress& progress_;
  Picture first_, second_;
  double size_ = 0.0;  ///< rms of the truth
};

}  // namespace prelight::benchmarks
