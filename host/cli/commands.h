#pragma once

#include <CLI/CLI.hpp>

#include "cli/context.h"

/// Each function adds one command to a program; `bench` is added by the programs themselves. The command runs
/// when parsing succeeds and throws if it fails. `context` must outlive the parse.
namespace prelight::cli {

void addBakeCommand(CLI::App& program, Context& context);
void addRenderCommand(CLI::App& program, Context& context);
void addReferenceCommand(CLI::App& program, Context& context);
void addViewCommand(CLI::App& program, Context& context);
void addMergeCommand(CLI::App& program, Context& context);
void addInfoCommand(CLI::App& program, Context& context);
void addSceneCommand(CLI::App& program, Context& context);
void addDevicesCommand(CLI::App& program, Context& context);
void addCompareCommand(CLI::App& program, Context& context);
void addPlotCommand(CLI::App& program, Context& context);
void addHelpCommand(CLI::App& program, Context& context);
void addExportCommand(CLI::App& program, Context& context);

}  // namespace prelight::cli
