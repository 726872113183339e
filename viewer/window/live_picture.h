#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "viewer/frame/renderer.h"
#include "viewer/gl/framebuffer.h"

namespace prelight::viewer {

/// Keeps the picture of a view that changes up to date: draws only when it has changed, with one sample a
/// pixel while it moves where more would not be fluent, with all of them when it has settled.
class LivePicture {
 public:
  static constexpr double fluentFrame = 1.0 / 60.0;  ///< s; slower pictures have one sample while they move

  /// `fullSamples` a pixel's side, >= 1. The renderer outlives it.
  LivePicture(Renderer& renderer, int fullSamples) : renderer_(renderer), fullSamples_(fullSamples) {}

  /// Draws the view unless that was done: `changes` tells one state of it from another. `settled`: it stands
  /// still, so there is time for all samples.
  void update(const View& view, std::size_t changes, bool settled);

  /// The next update() draws, whatever the view.
  void invalidate() { drawn_.reset(); }

  /// The picture of the last update(), with samples() samples per side of a pixel.
  const gl::Framebuffer& target() const { return *target_; }
  int samples() const { return samples_; }

  /// update() with these changes would draw nothing.
  bool isFinal(std::size_t changes) const { return drawn_ == changes && samples_ == fullSamples_; }

  double lastSeconds() const { return lastSeconds_; }  ///< that the last picture took to draw

 private:
  int samplesFor(bool settled) const;

  Renderer& renderer_;
  int fullSamples_;
  std::optional<gl::Framebuffer> target_;
  int samples_ = 0;
  std::optional<std::size_t> drawn_;   ///< changes that the picture shows
  std::optional<double> fullSeconds_;  ///< that a picture of all samples takes, as far as is known
  double lastSeconds_ = 0.0;
};

}  // namespace prelight::viewer
