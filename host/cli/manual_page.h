#pragma once

#include <string>
#include <string_view>

#include "cli/command_table.h"

namespace prelight::cli {

/// Returns the page prelight(1), in roff with the macros of man(7).
std::string manualPage(const CommandTable& table, std::string_view version);

}  // namespace prelight::cli
