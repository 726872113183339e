#include "viewer/window/live_picture.h"

#include <algorithm>

#include "base/clocks.h"

namespace prelight::viewer {
namespace {

/// Makes the target anew where it is not of that size.
const gl::Framebuffer& targetOf(std::optional<gl::Framebuffer>& target, int width, int height) {
  if (!target || target->width() != width || target->height() != height) target.emplace(width, height);
  return *target;
}

View partOf(const View& view, int divisor) {
  View smaller = view;
  smaller.width = std::max(1, (view.width + divisor - 1) / divisor);
  smaller.height = std::max(1, (view.height + divisor - 1) / divisor);
  return smaller;
}

}  // namespace

void LivePicture::invalidate() {
  work_.reset();
  drawn_.reset();
}

void LivePicture::refineAgain() {
  work_.reset();
  stage_ = Stage::AllSamples;
}

/// All samples take no longer than a draft may.
bool LivePicture::isDrawnAtOnce(const View& view) const {
  return shading_ == view.shading && fullSeconds_ && *fullSeconds_ <= fluentFrame;
}

void LivePicture::update(const View& view, std::size_t changes, bool settled) {
  if (drawn_ != changes) {
    work_.reset();
    if (shading_ != view.shading) {
      draftSize_.restart();
      fullSeconds_.reset();
    }
    const bool atOnce = isDrawnAtOnce(view);
    shading_ = view.shading;
    targetOf(shown_, view.width, view.height);
    drawn_ = changes;
    if (!atOnce) return drawDraft(view);
    stage_ = Stage::AllSamples;
    while (stage_ != Stage::Done) drawSlice(view);
    return;
  }
  if (stage_ != Stage::Done && (settled || isDrawnAtOnce(view))) drawSlice(view);
}

void LivePicture::finish(const View& view, std::size_t changes) {
  while (!isFinal(changes)) update(view, changes, true);
}

void LivePicture::drawDraft(const View& view) {
  const int divisor = draftSize_.divisor();
  View drawn = partOf(view, divisor);
  drawn.draft = divisor > 1 || fullSamples_ > 1;
  const double start = steadySeconds();
  const gl::Framebuffer& target = divisor > 1 ? targetOf(draft_, drawn.width, drawn.height) : *shown_;
  renderer_.draw(drawn, {0, 0, drawn.width, drawn.height}, target);
  if (divisor > 1) resolver_.resolve(target, {0, 0, drawn.width, drawn.height}, *shown_);
  gl::Framebuffer::finish();
  lastSeconds_ = steadySeconds() - start;
  draftSize_.drew(lastSeconds_);
  if (!drawn.draft)
    stage_ = Stage::Done;
  else
    stage_ = divisor > 1 ? Stage::AllPixels : Stage::AllSamples;
}

void LivePicture::startStage(const View& view) {
  View drawn = view;
  workSeconds_ = 0.0;
  if (stage_ == Stage::AllPixels || fullSamples_ == 1) {
    drawn.draft = stage_ == Stage::AllPixels;
    work_.emplace(renderer_.drawSliced(drawn, *shown_, sliceSeconds, {}));
    return;
  }
  const gl::Framebuffer& samples = targetOf(samples_, view.width * fullSamples_, view.height * fullSamples_);
  work_.emplace(renderer_.drawSliced(drawn, samples, sliceSeconds, [this](const SampleRect& rect) {
    resolver_.resolve(*samples_, rect, *shown_);
  }));
}

void LivePicture::drawSlice(const View& view) {
  const double start = steadySeconds();
  if (!work_) startStage(view);
  const bool goesOn = work_->goOn();
  if (!goesOn && stage_ == Stage::AllSamples && fullSamples_ > 1)
    resolver_.resolve(*samples_, {0, 0, samples_->width(), samples_->height()}, *shown_);
  gl::Framebuffer::finish();
  workSeconds_ += steadySeconds() - start;
  if (goesOn) return;
  work_.reset();
  lastSeconds_ = workSeconds_;
  if (stage_ == Stage::AllSamples) fullSeconds_ = workSeconds_;
  stage_ = stage_ == Stage::AllPixels ? Stage::AllSamples : Stage::Done;
}

}  // namespace prelight::viewer
