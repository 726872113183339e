#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <vector>

#include "prelight/scene.h"

namespace prelight::cli {

/// Adds --light, which replaces a scene's lights.
void addLightOption(CLI::App& app, std::optional<std::vector<Light>>& lights);

}  // namespace prelight::cli
