#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/picture_error.h"
#include "integrators/reference.h"
#include "prelight/device.h"
#include "prelight/picture.h"
#include "prelight/progress.h"

namespace prelight::benchmarks {

/// A traced picture: the mean of two of independent samples, which tell how good it is.
struct Truth {
  int depth = 0;                       ///< segments of its paths at most
  std::vector<std::uint64_t> samples;  ///< a pixel, of each part
  double seconds = 0.0;                ///< of its parts
  double rmse = 0.0;                   ///< standard error of the picture, in the measure of pictureRmse
  double flip = 0.0;                   ///< of one half against the other
  Picture first, second;
  Picture picture;                   ///< their mean
  std::vector<glm::vec3> displayed;  ///< [row][column], tone-mapped and sRGB-encoded
};

/// "512 + 128".
std::string samplesText(const Truth& truth);

/// How long a truth is traced.
struct TruthEffort {
  std::uint64_t mostSamples = 0;  ///< a pixel, of each part
  double mostSeconds = 0.0;       ///< about
};

/// [row][column], tone-mapped and sRGB-encoded.
std::vector<glm::vec3> displayed(const Picture& picture);

/// Light of paths of some lengths, as it is traced again and again. What it refers to outlives it.
class TracedLight {
 public:
  /// Samples and seed of the request are chosen here.
  TracedLight(const reference::ReferenceInputs& inputs, reference::ReferenceRequest request,
              const Device& device, const Progress& progress);

  /// Twice as many samples as before.
  void grow();

  std::uint64_t samples() const;  ///< a pixel, after the first grow()
  double seconds() const { return seconds_; }
  double nextSeconds() const;  ///< of the next grow(), about
  double rmse() const { return rmse_; }
  const Picture& half(int which) const { return pictures_[static_cast<std::size_t>(which)]; }

 private:
  struct Half {
    reference::ReferenceRequest request;
    reference::Film film;
  };

  const reference::ReferenceInputs& inputs_;
  const Device& device_;
  const Progress& progress_;
  std::array<Half, 2> halves_;
  std::array<Picture, 2> pictures_;
  std::uint64_t next_;  ///< samples of a half
  double seconds_ = 0.0;
  double rmse_ = 0.0;  ///< standard error
};

/// The sum of parts, of which the one whose noise costs least to lessen grows again and again, until
/// `isEnough` or the next would be beyond the effort.
Truth traceTruth(std::span<TracedLight* const> parts, const TruthEffort& effort,
                 const std::function<bool(const Truth&)>& isEnough);

}  // namespace prelight::benchmarks
