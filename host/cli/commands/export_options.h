#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "export/export_request.h"
#include "gi/probes/probe_light.h"
#include "prelight/load.h"

namespace prelight::cli {

/// The options of `prelight export`.
struct ExportOptions {
  std::filesystem::path baked;
  std::filesystem::path output;
  LoadOptions load;
  bool allowsStale = false;
  bool dryRun = false;
  std::string target = "gltf";
  std::string form;    ///< empty: the form that the bake holds
  std::string lights;  ///< empty: the lights are removed
  std::vector<std::filesystem::path> skies;
  std::optional<double> exposure;  ///< for pages
  ProbeRequest probes;
  std::optional<std::uint32_t> rays;  ///< per probe or per texel of occlusion; none: the usual number

  /// Whether the target is a page, which the viewer makes and for which there is no ExportTarget.
  bool isPage() const;
};

void addExportOptions(CLI::App& app, ExportOptions& options);

/// Returns the request for export/, or nothing for a page. Throws UsageError for unknown names and for
/// options that the target would ignore; `targetOption` names the option that chose the target.
std::optional<ExportRequest> exportRequestOf(const ExportOptions& options,
                                             const std::string& targetOption = "--target");

/// Throws UsageError if the output, given by `option`, cannot be written for the target.
void checkExportOutput(const std::string& option, const ExportOptions& options);

}  // namespace prelight::cli
