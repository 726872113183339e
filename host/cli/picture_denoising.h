#pragma once

#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/session.h"
#include "denoise/denoiser.h"

namespace prelight::cli {

/// What --denoise does to pictures that are traced.
class PictureDenoising {
 public:
  /// Begins to load the denoiser, if it is wanted.
  explicit PictureDenoising(bool wanted);

  bool wanted() const { return loading_.valid() || denoiser_ != nullptr; }

  /// Waits until it is loaded: before anything else takes time. Throws where it cannot be.
  void require();

  void apply(Session& session, const Guides& guides, DenoiseEffort effort, Picture& picture);

  /// Line and member of reports; nothing where it is not wanted.
  void print(const Console& console) const;
  void addTo(nlohmann::ordered_json& report) const;

 private:
  std::future<std::unique_ptr<Denoiser>> loading_;
  std::unique_ptr<Denoiser> denoiser_;
};

}  // namespace prelight::cli
