#pragma once

#include <CLI/CLI.hpp>

#include "viewer/lights/illumination.h"

namespace prelight::cli {

/// Adds the options of vo shading.
void addOccluderOptions(CLI::App& app, viewer::OccluderOptions& options);

}  // namespace prelight::cli
