#pragma once

#include <CLI/CLI.hpp>

#include "pictures/session/bake_settings.h"

namespace prelight::cli {

using pictures::BakeSettings;
using pictures::techniqueText;
using pictures::useDefaultTechniques;

/// Adds the options of techniques and those that refine them.
void addTechniqueOptions(CLI::App& app, BakeSettings& options);

/// Adds --refine and --refine-vertices.
void addRefineOptions(CLI::App& app, BakeSettings& options);

/// Adds --caustics and --photons of light maps.
void addMapPhotonOptions(CLI::App& app, BakeRequest& request);

/// Adds --rays, --error, --time, --seed and --max-memory.
void addEffortOptions(CLI::App& app, BakeSettings& options);

/// Adds --cache-kernels and --dump-kernels.
void addKernelOptions(CLI::App& app, BakeSettings& options);

}  // namespace prelight::cli
