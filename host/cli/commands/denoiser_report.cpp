#include "cli/commands/denoiser_report.h"

#include <fmt/format.h>

namespace prelight::cli {

void printDenoiser(const Console& console, const pictures::PictureDenoising& denoising) {
  if (const Denoiser* used = denoising.denoiser())
    console.line("denoised", fmt::format("by {} ({})", used->name(), used->file()));
}

void addDenoiser(nlohmann::ordered_json& report, const pictures::PictureDenoising& denoising) {
  if (const Denoiser* used = denoising.denoiser())
    report["denoiser"] = {{"name", used->name()}, {"file", used->file()}};
}

}  // namespace prelight::cli
