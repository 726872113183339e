#pragma once

#include <cstddef>
#include <optional>

#include "viewer/core/picture_slices.h"
#include "viewer/core/sliced_work.h"
#include "viewer/frame/renderer.h"
#include "viewer/gl/framebuffer.h"
#include "viewer/window/resolver.h"

namespace prelight::viewer {

/// Keeps the picture of a view that changes up to date, and never draws for long at once. While the view
/// moves it draws drafts, as fine as they are fluent. When the view has settled, slices of the picture with
/// all samples replace the draft one after the other.
class LivePicture {
 public:
  static constexpr double fluentFrame = 1.0 / 60.0;  ///< s; quicker pictures have all samples at any time
  static constexpr double sliceSeconds = 0.025;      ///< about, of a slice

  /// `fullSamples` a pixel's side, >= 1. The renderer outlives it.
  LivePicture(Renderer& renderer, int fullSamples) : renderer_(renderer), fullSamples_(fullSamples) {}

  /// Draws a draft of the view unless that was done, and otherwise, where it is `settled`, a further slice:
  /// `changes` tells one state of the view from another.
  void update(const View& view, std::size_t changes, bool settled);

  /// Calls update() until the picture has all its samples.
  void finish(const View& view, std::size_t changes);

  /// The next update() draws a draft, whatever the view.
  void invalidate();

  /// Draws all samples again, from the next update() on: the same view would look better now.
  void refineAgain();

  /// The picture, with one sample per pixel of the window.
  const gl::Framebuffer& shown() const { return *shown_; }

  /// Whether a draft is shown, or all samples of some slices alone.
  bool isDraft() const { return stage_ != Stage::Done; }

  /// update() with these changes would draw nothing.
  bool isFinal(std::size_t changes) const { return drawn_ == changes && !isDraft(); }

  double lastSeconds() const { return lastSeconds_; }  ///< that the last draft, or all of the picture, took

  const DraftSize& draftSize() const { return draftSize_; }

 private:
  /// The samples that update() draws next of a view that has settled.
  enum class Stage { AllPixels, AllSamples, Done };

  void drawDraft(const View& view);
  void startStage(const View& view);
  void drawSlice(const View& view);
  bool isDrawnAtOnce(const View& view) const;

  Renderer& renderer_;
  int fullSamples_;
  Resolver resolver_;
  DraftSize draftSize_;
  std::optional<Shading> shading_;                          ///< of the last draft
  std::optional<gl::Framebuffer> shown_, draft_, samples_;  ///< the last two where they have another size
  std::optional<SlicedWork> work_;                          ///< of the stage, once it has begun
  Stage stage_ = Stage::AllSamples;
  std::optional<std::size_t> drawn_;   ///< changes that the picture shows
  std::optional<double> fullSeconds_;  ///< that a picture of all samples takes, as far as is known
  double workSeconds_ = 0.0;           ///< that the slices of the stage took
  double lastSeconds_ = 0.0;
};

}  // namespace prelight::viewer
