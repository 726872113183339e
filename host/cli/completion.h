#pragma once

#include <string>

#include "cli/command_table.h"

namespace prelight::cli {

enum class Shell { Bash, Zsh, Fish };

/// A script by which the shell completes commands and options; where a value stands, it completes files.
std::string completion(const CommandTable& table, Shell shell);

}  // namespace prelight::cli
