#pragma once

#include <string>

#include "cli/command_table.h"

namespace prelight::cli {

enum class Shell { Bash, Zsh, Fish };

/// Returns a script with which the shell completes commands and options. Values are completed as file names.
std::string completion(const CommandTable& table, Shell shell);

}  // namespace prelight::cli
