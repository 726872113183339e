#pragma once

#include <CLI/CLI.hpp>

#include "integrators/live_virtual_lights.h"

namespace prelight::cli {

/// Adds the options of instant shading.
void addVirtualLightOptions(CLI::App& app, VirtualLightOptions& options);

}  // namespace prelight::cli
