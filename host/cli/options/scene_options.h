#pragma once

#include <CLI/CLI.hpp>

#include "prelight/load.h"

namespace prelight::cli {

/// Adds --scene, --variant, --scale and --brdf.
void addSceneOptions(CLI::App& app, LoadOptions& options);

/// Adds --at, the moment of the animation in which the scene is loaded.
CLI::Option* addMomentOption(CLI::App& app, LoadOptions& options);

/// Adds --at, and --animation, which needs it.
void addMomentOptions(CLI::App& app, LoadOptions& options);

/// Throws UsageError if an animation is given without a moment.
void checkMoment(const LoadOptions& options);

}  // namespace prelight::cli
