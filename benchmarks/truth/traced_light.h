#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "base/state_file.h"
#include "gpu/transport_scene.h"
#include "integrators/path_tracer.h"
#include "integrators/reference.h"
#include "prelight/device.h"
#include "prelight/picture.h"
#include "prelight/progress.h"

namespace prelight::benchmarks {

/// Light of paths of some lengths in a picture, traced twice with independent samples, a block of pixels at a
/// time, so that samples go where they are worth most. A first look, which is no part of it, tells how much
/// pixels vary: samples that chose their own number would be biased. What it refers to outlives it.
class TracedLight {
 public:
  /// Samples and seed of the request are chosen here, its samples are the most of a pass.
  TracedLight(const reference::ReferenceInputs& inputs, reference::ReferenceRequest request,
              const Device& device, const Progress& progress);

  std::size_t blockCount() const { return passes_.size(); }

  /// Traces a pass of a block in both halves.
  void trace(std::size_t block);

  std::uint32_t passes(std::size_t block) const { return passes_[block]; }  ///< passes of each half
  double secondsOf(std::size_t block) const;  ///< seconds of a pass of both halves, once it has had one
  std::uint64_t samples() const;              ///< a pixel, the mean of all
  double seconds() const;                     ///< seconds of all passes

  /// [pixel] variance of a pass' mean, by the first look.
  const std::vector<glm::vec3>& variance() const { return variance_; }
  const Picture& firstLook() const { return firstLook_; }

  /// The pixels of a block.
  std::size_t begin(std::size_t block) const { return block * blockPixels_; }
  std::size_t end(std::size_t block) const;

  /// Mean radiance of a half, once every block has a pass.
  Picture half(std::size_t which) const;

  /// Takes over what was traced of the same light before, where a folder keeps it.
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

}  // namespace prelight::benchmarks
