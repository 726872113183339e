#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/truth/traced_light.h"
#include "prelight/picture.h"

namespace prelight::benchmarks {

/// A traced picture: the mean of two of independent samples, which tell how good it is.
struct Truth {
  int depth = 0;                       ///< segments of its paths at most
  std::vector<std::uint64_t> samples;  ///< a pixel, of each part, the mean over pixels
  double seconds = 0.0;                ///< seconds of its parts
  double rmse = 0.0;                   ///< standard error of the picture, in the measure of pictureRmse
  Picture first, second;
  Picture picture;                   ///< their mean
  std::vector<glm::vec3> displayed;  ///< [row][column], tone-mapped and sRGB-encoded
};

/// "512 + 128".
std::string samplesText(const Truth& truth);

/// How long a truth is traced.
struct TruthEffort {
  std::uint64_t mostSamples = 0;  ///< a pixel, of each part, the mean over pixels
  double mostSeconds = 0.0;       ///< about, beside one pass of every block
};

/// [row][column], tone-mapped and sRGB-encoded.
std::vector<glm::vec3> displayed(const Picture& picture);

/// The sum of parts. Passes go to the blocks of pixels, of whichever part, where they take most of the
/// variance in a second, until `isEnough` or the effort is spent; pixels that are brighter than white, which
/// errors do not tell apart, have none.
Truth traceTruth(std::span<TracedLight* const> parts, const TruthEffort& effort,
                 const std::function<bool(const Truth&)>& isEnough);

}  // namespace prelight::benchmarks
