#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <vector>

#include "cli/session.h"

namespace prelight::cli {

/// --light; nullopt: the file's.
void addLightOption(CLI::App& app, std::optional<std::vector<Light>>& lights);

/// Whether area lights or cookies are among them.
bool anyDrawnOnly(const std::optional<std::vector<Light>>& lights);

/// Takes area lights out and makes emissive surfaces of the scene of them, for what traces light. True where
/// there were any. Throws UsageError for cookies, which are not traced.
bool makeSurfaces(std::optional<std::vector<Light>>& lights, LoadedScene& loaded);

}  // namespace prelight::cli
