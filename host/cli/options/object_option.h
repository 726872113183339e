#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "prelight/draw.h"

namespace prelight::cli {

/// Adds --object, "FILE:x,y,z[:yaw[:scale]]", where the file's name may have colons.
void addObjectOption(CLI::App& app, std::vector<PlacedObject>& objects, const std::string& help);

}  // namespace prelight::cli
