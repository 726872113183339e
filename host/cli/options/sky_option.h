#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

namespace prelight::cli {

/// Adds --env: a file or the name of a built-in sky. `help` says what it is the sky of.
void addSkyOption(CLI::App& app, std::filesystem::path& sky, const char* help);

}  // namespace prelight::cli
