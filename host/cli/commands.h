#pragma once

#include <CLI/CLI.hpp>

#include "cli/global_options.h"

/// Each function adds one command to the program. The command runs when parsing succeeds; it reports failure
/// by throwing. `global` must outlive the parse.
namespace prelight::cli {

void addBakeCommand(CLI::App& program, const GlobalOptions& global);
void addRenderCommand(CLI::App& program, const GlobalOptions& global);
void addViewCommand(CLI::App& program, const GlobalOptions& global);
void addInfoCommand(CLI::App& program, const GlobalOptions& global);
void addSceneCommand(CLI::App& program, const GlobalOptions& global);
void addDevicesCommand(CLI::App& program, const GlobalOptions& global);
void addCompareCommand(CLI::App& program, const GlobalOptions& global);

}  // namespace prelight::cli
