#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/session.h"

namespace prelight::cli {

/// Where a bake is exported as well, and whom for.
struct ExportAfterBake {
  std::filesystem::path output;  ///< a folder or a .glb; empty: nowhere
  std::string target = "gltf";
};

/// Throws UsageError for an unknown target, and unless it can be written.
void checkExport(const ExportAfterBake& wanted);

/// Exports a file that was just baked as `prelight export` does by itself. Returns its report.
nlohmann::ordered_json exportBaked(const std::filesystem::path& baked, const ExportAfterBake& wanted,
                                   Session& session);

}  // namespace prelight::cli
