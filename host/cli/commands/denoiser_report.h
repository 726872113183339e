#pragma once

#include <nlohmann/json.hpp>

#include "cli/console/console.h"
#include "pictures/picture_denoising.h"

namespace prelight::cli {

/// Prints which denoiser was used. Nothing where none was.
void printDenoiser(const Console& console, const pictures::PictureDenoising& denoising);

/// Adds the denoiser to a report. Nothing where none was used.
void addDenoiser(nlohmann::ordered_json& report, const pictures::PictureDenoising& denoising);

}  // namespace prelight::cli
