#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/state_file.h"
#include "gpu/transport_scene.h"
#include "integrators/path_tracer.h"
#include "integrators/reference.h"
#include "prelight/device.h"
#include "prelight/picture.h"
#include "prelight/progress.h"

namespace prelight::benchmarks {

/// A picture of the light of paths of some lengths, traced twice with independent samples. Pixels are traced
/// in blocks, so that samples go where they help most. A separate first look measures how much pixels vary:
/// samples that decide their own number would be biased. Everything that is passed by reference must outlive
/// this object.
class TracedLight {
 public:
  /// Replaces the request's seed, and uses its samples as the largest number per pass.
  TracedLight(const reference::ReferenceInputs& inputs, reference::ReferenceRequest request,
              const Device& device, const Progress& progress);

  std::size_t blockCount() const { return passes_.size(); }

  /// Traces a pass of a block in both halves.
  void trace(std::size_t block);

  std::uint32_t passes(std::size_t block) const { return passes_[block]; }  ///< number of passes of each half
  double secondsOf(
      std::size_t block) const;   ///< seconds per pass of both halves; the block must have had a pass
  std::uint64_t samples() const;  ///< samples per pixel, mean over all pixels
  double seconds() const;         ///< seconds of all passes

  /// Returns [pixel] the variance of the mean of a pass, as the first look found it.
  const std::vector<glm::vec3>& variance() const { return variance_; }
  const Picture& firstLook() const { return firstLook_; }

  /// Return the first pixel of a block and the one behind its last.
  std::size_t begin(std::size_t block) const { return block * blockPixels_; }
  std::size_t end(std::size_t block) const;

  /// Returns the mean radiance of a half. Every block must have had a pass.
  Picture half(std::size_t which) const;

  /// Restores what earlier runs traced of the same light, if the folder has it.
  void restore(const std::filesystem::path& folder);
  void save(const std::filesystem::path& folder) const;

 private:
  void look();
  std::filesystem::path fileIn(const std::filesystem::path& folder) const;
  StateKey key() const;

  const reference::ReferenceInputs& inputs_;
  reference::ReferenceRequest request_;
  const Progress& progress_;
  DeviceInfo device_;
  TransportScene scene_;
  reference::PathTracer tracer_;
  std::size_t blockPixels_;
  bool looked_ = false;
  std::vector<std::uint32_t> passes_;  ///< [block] of each half
  std::vector<double> seconds_;        ///< [block] of all its passes
  double lookSeconds_ = 0.0;
  std::array<std::vector<glm::dvec3>, 2> sums_;  ///< [half][pixel]
  std::vector<glm::vec3> variance_;
  Picture firstLook_;
};

/// A traced picture: the mean of two pictures with independent samples, whose difference shows its quality.
struct Truth {
  int depth = 0;                       ///< largest number of segments of its paths
  std::vector<std::uint64_t> samples;  ///< [part] samples per pixel, mean over pixels
  double seconds = 0.0;                ///< seconds of its parts
  double rmse = 0.0;                   ///< standard error of the picture, as by pictureRmse()
  Picture first, second;
  Picture picture;                   ///< their mean
  std::vector<glm::vec3> displayed;  ///< [row][column], tone-mapped and sRGB-encoded
};

/// "512 + 128".
std::string samplesText(const Truth& truth);

/// Limits of the time and samples of a truth.
struct TruthEffort {
  std::uint64_t mostSamples = 0;  ///< [part] samples per pixel, mean over pixels
  double mostSeconds = 0.0;       ///< approximate seconds after one pass of every block
};

/// Returns [row][column], tone-mapped and sRGB-encoded.
std::vector<glm::vec3> displayed(const Picture& picture);

/// Returns the sum of the parts. Passes go to those blocks of pixels, of any part, where they reduce the
/// variance most per second, until `isEnough` holds or the effort is spent. Pixels brighter than white count
/// as having no variance, since errors do not tell such values apart.
Truth traceTruth(std::span<TracedLight* const> parts, const TruthEffort& effort,
                 const std::function<bool(const Truth&)>& isEnough);

}  // namespace prelight::benchmarks
