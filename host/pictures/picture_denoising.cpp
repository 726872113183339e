#include "pictures/picture_denoising.h"

namespace prelight::pictures {

PictureDenoising::PictureDenoising(bool wanted) {
  if (wanted) loading_ = std::async(std::launch::async, [] { return std::make_unique<Denoiser>(); });
}

void PictureDenoising::require() {
  if (loading_.valid()) denoiser_ = loading_.get();
}

void PictureDenoising::apply(DrawingSession& session, const Guides& guides, DenoiseEffort effort,
                             Picture& picture) {
  if (!wanted()) return;
  require();
  picture = session.measure("denoise",
                            [&] { return denoiser_->denoise(picture, guides, effort, session.progress()); });
}

}  // namespace prelight::pictures
