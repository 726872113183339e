#pragma once

#include <future>
#include <memory>

#include "denoise/denoiser.h"
#include "pictures/session/drawing_session.h"

namespace prelight::pictures {

/// Denoises pictures that are traced, if that is wanted.
class PictureDenoising {
 public:
  /// Begins to load the denoiser if it is wanted.
  explicit PictureDenoising(bool wanted);

  bool wanted() const { return loading_.valid() || denoiser_ != nullptr; }

  /// Waits until the denoiser is loaded, before anything else takes time. Throws if it cannot be loaded.
  void require();

  void apply(DrawingSession& session, const Guides& guides, DenoiseEffort effort, Picture& picture);

  /// Null where it is not wanted, or not loaded yet.
  const Denoiser* denoiser() const { return denoiser_.get(); }

 private:
  std::future<std::unique_ptr<Denoiser>> loading_;
  std::unique_ptr<Denoiser> denoiser_;
};

}  // namespace prelight::pictures
