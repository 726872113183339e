#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <vector>

#include "cli/session.h"

namespace prelight::cli {

/// What only pages have.
struct PageOptions {
  std::vector<std::filesystem::path> skies;  ///< files, or built-in ones by name; empty: as a picture has it
  std::optional<double> exposure;

  bool given() const { return !skies.empty() || exposure.has_value(); }
};

void addPageOptions(CLI::App& app, PageOptions& options);

/// `export --target web`: writes one .html that relights the scene.
void exportPage(Session& session, const std::filesystem::path& baked, const std::filesystem::path& output,
                const LoadOptions& load, const PageOptions& options);

}  // namespace prelight::cli
