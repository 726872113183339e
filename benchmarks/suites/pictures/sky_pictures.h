#pragma once

#include <cstdint>

#include "benchmarks/run/measure.h"
#include "benchmarks/suites/pictures/pictures_suite.h"
#include "benchmarks/truth/picture_error.h"
#include "integrators/reference.h"
#include "viewer/core/shading.h"

namespace prelight::benchmarks {

/// Returns a sky of two lobes, which SH of order 3 represent exactly, with radiance below 1.
Environment makeLobedSky(int rows);

/// Returns a path-traced picture from the scene's first camera, lit by the sky alone, or without one by the
/// scene's own lights.
Picture tracedPicture(const BenchmarkScene& scene, const Environment* sky,
                      const reference::ReferenceRequest& request, const Device& device,
                      const Progress& progress);

/// Error and time of a picture.
struct SkyPicture {
  MeasuredError error;   ///< relative to the truth's rms
  double seconds = 0.0;  ///< processor time of bake and picture
  std::uint64_t rays = 0;
};

/// A scene under a sky alone, path traced twice with independent samples, with which pictures are compared.
/// Needs a current OpenGL context. The arguments must outlive it.
class SkyTrial {
 public:
  SkyTrial(const BenchmarkScene& scene, const Environment& sky, const PicturesOptions& options,
           const Device& device, const Progress& progress);

  /// Bakes and draws.
  SkyPicture draw(const BakeRequest& request, viewer::Shading shading) const;

  /// Path traces a picture with samples that are independent of the truths.
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
