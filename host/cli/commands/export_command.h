#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/session.h"

namespace prelight::cli {

/// An export that follows a bake.
struct ExportAfterBake {
  std::filesystem::path output;  ///< a folder or a .glb; empty: no export
  std::string target = "gltf";
};

/// Throws UsageError if the target is unknown or the output cannot be written.
void checkExport(const ExportAfterBake& wanted);

/// Exports a file that was just baked, as `prelight export` does. Returns the export's report.
nlohmann::ordered_json exportBaked(const std::filesystem::path& baked, const ExportAfterBake& wanted,
                                   Session& session);

}  // namespace prelight::cli
