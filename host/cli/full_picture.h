#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cli/picture_options.h"
#include "integrators/full_renderer.h"

namespace prelight::cli {

/// The options of full shading's light.
void addFullOptions(CLI::App& app, FullRequest& request);

/// Makes a picture with all light and writes it, as `render --shading full` does.
void renderFullPicture(Session& session, const PictureOptions& options, const FullRequest& request,
                       const std::filesystem::path& output);

}  // namespace prelight::cli
