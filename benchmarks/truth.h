#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "benchmarks/picture_error.h"
#include "integrators/reference.h"
#include "prelight/device.h"
#include "prelight/picture.h"
#include "prelight/progress.h"

namespace prelight::benchmarks {

/// A path-traced picture: the mean of two of independent samples, which tell how good it is.
struct Truth {
  int depth = 0;              ///< segments of its paths at most
  std::uint64_t samples = 0;  ///< a pixel
  double seconds = 0.0;
  double rmse = 0.0;  ///< standard error of the picture, in the measure of pictureRmse
  double flip = 0.0;  ///< of one half against the other
  Picture first, second;
  Picture picture;                   ///< their mean
  std::vector<glm::vec3> displayed;  ///< [row][column], tone-mapped and sRGB-encoded
};

/// How long a truth is traced.
struct TruthEffort {
  std::uint64_t mostSamples = 0;  ///< a pixel
  double mostSeconds = 0.0;       ///< about
};

/// [row][column], tone-mapped and sRGB-encoded.
std::vector<glm::vec3> displayed(const Picture& picture);

/// Traces twice as many samples again and again until `isEnough`, or the next would be beyond the effort. The
/// request's samples and seed are chosen here.
Truth traceTruth(const reference::ReferenceInputs& inputs, reference::ReferenceRequest request,
                 const TruthEffort& effort, const Device& device, const Progress& progress,
                 const std::function<bool(const Truth&)>& isEnough);

}  // namespace prelight::benchmarks
