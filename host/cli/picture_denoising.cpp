#include "cli/picture_denoising.h"

#include <fmt/format.h>

namespace prelight::cli {

PictureDenoising::PictureDenoising(bool wanted) {
  if (wanted) loading_ = std::async(std::launch::async, [] { return std::make_unique<Denoiser>(); });
}

void PictureDenoising::require() {
  if (loading_.valid()) denoiser_ = loading_.get();
}

void PictureDenoising::apply(Session& session, const Guides& guides, DenoiseEffort effort, Picture& picture) {
  if (!wanted()) return;
  require();
  picture = session.times().measure(
      "denoise", [&] { return denoiser_->denoise(picture, guides, effort, session.progress()); });
}

void PictureDenoising::print(const Console& console) const {
  if (denoiser_) console.line("denoised", fmt::format("by {} ({})", denoiser_->name(), denoiser_->file()));
}

void PictureDenoising::addTo(nlohmann::ordered_json& report) const {
  if (denoiser_) report["denoiser"] = {{"name", denoiser_->name()}, {"file", denoiser_->file()}};
}

}  // namespace prelight::cli
