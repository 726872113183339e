#pragma once

#include <CLI/CLI.hpp>

#include "prelight/load.h"

namespace prelight::cli {

/// --scene, --variant, --scale and --brdf.
void addSceneOptions(CLI::App& app, LoadOptions& options);

/// --at, the moment that the scene is loaded in.
CLI::Option* addMomentOption(CLI::App& app, LoadOptions& options);

/// --at, and --animation for it alone.
void addMomentOptions(CLI::App& app, LoadOptions& options);

/// Throws UsageError for an animation without a moment.
void checkMoment(const LoadOptions& options);

}  // namespace prelight::cli
