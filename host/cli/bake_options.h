#pragma once

#include <CLI/CLI.hpp>

#include "library/bake_settings.h"

namespace prelight::cli {

/// --ao, --sh, --ch, --haar, --glossy, --light-groups, --bounces, and what shapes them.
void addTechniqueOptions(CLI::App& app, BakeSettings& options);

/// --rays, --error, --time, --seed and --max-memory.
void addEffortOptions(CLI::App& app, BakeSettings& options);

/// --cache-kernels and --dump-kernels.
void addKernelOptions(CLI::App& app, BakeSettings& options);

}  // namespace prelight::cli
