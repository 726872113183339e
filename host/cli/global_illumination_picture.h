#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cli/picture_options.h"
#include "integrators/global_illumination_renderer.h"

namespace prelight::cli {

/// The options of light in pictures of global illumination.
void addGlobalIlluminationOptions(CLI::App& app, GlobalIlluminationPictureRequest& request);

/// Makes a picture with all light and writes it, as `render --shading full` does.
void renderGlobalIlluminationPicture(Session& session, const PictureOptions& options,
                                     const GlobalIlluminationPictureRequest& request,
                                     const std::filesystem::path& output);

}  // namespace prelight::cli
