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

/// What `prelight export` is asked for.
struct ExportOptions {
  std::filesystem::path baked;
  std::filesystem::path output;
  LoadOptions load;
  bool allowsStale = false;
  bool dryRun = false;
  std::string target = "gltf";
  std::string form;    ///< empty: what the bake holds
  std::string lights;  ///< empty: removed
  std::vector<std::filesystem::path> skies;
  std::optional<double> exposure;  ///< of pages
  ProbeRequest probes;
  std::optional<std::uint32_t> rays;  ///< of a probe, or of a texel of occlusion; none: as many as are usual

  bool isPage() const;  ///< which the viewer makes, and which has no ExportTarget
};

void addExportOptions(CLI::App& app, ExportOptions& options);

/// What is asked of export/; of a page, nothing. Throws UsageError for unknown names and for options that the
/// target would pass over; `targetOption` is what the target was given by.
std::optional<ExportRequest> exportRequestOf(const ExportOptions& options,
                                             const std::string& targetOption = "--target");

/// Throws UsageError unless the output, given by `option`, can be written for the target.
void checkExportOutput(const std::string& option, const ExportOptions& options);

}  // namespace prelight::cli
