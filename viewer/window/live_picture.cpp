#include "viewer/window/live_picture.h"

namespace prelight::viewer {

int LivePicture::samplesFor(bool settled) const {
  return settled || (fullSeconds_ && *fullSeconds_ <= fluentFrame) ? fullSamples_ : 1;
}

void LivePicture::update(const View& view, std::size_t changes, bool settled) {
  using Clock = std::chrono::steady_clock;
  const int wanted = samplesFor(settled);
  if (drawn_ == changes && samples_ >= wanted) return;
  if (!target_ || target_->width() != view.width * wanted || target_->height() != view.height * wanted)
    target_.emplace(view.width * wanted, view.height * wanted);
  const auto start = Clock::now();
  View drawn = view;
  drawn.draft = wanted < fullSamples_;
  renderer_.draw(drawn, {0, 0, view.width, view.height}, *target_);
  gl::Framebuffer::finish();
  lastSeconds_ = std::chrono::duration<double>(Clock::now() - start).count();
  // A picture of fewer samples must not make all of them look affordable.
  fullSeconds_ = lastSeconds_ * (fullSamples_ * fullSamples_) / (wanted * wanted);
  samples_ = wanted;
  drawn_ = changes;
}

}  // namespace prelight::viewer
