#pragma once

#include <CLI/CLI.hpp>

#include "pictures/pose.h"

namespace prelight::cli {

/// Adds --at, --animation and --move, "NODE:x,y,z[:yaw]", where the node's name may have colons.
void addPoseOptions(CLI::App& app, pictures::PoseOptions& options);

}  // namespace prelight::cli
