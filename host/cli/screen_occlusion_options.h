#pragma once

#include <CLI/CLI.hpp>

#include "viewer/core/occlusion_options.h"

namespace prelight::cli {

/// Adds the options of screen shading.
void addScreenOcclusionOptions(CLI::App& app, viewer::ScreenOcclusionOptions& options);

}  // namespace prelight::cli
