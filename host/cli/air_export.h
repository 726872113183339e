#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cli/session.h"
#include "export/export_bake.h"
#include "gi/probes/probe_light.h"

namespace prelight::cli {

/// What light at points in the air is gathered with.
struct ProbeOptions {
  ProbeRequest request;
  std::filesystem::path environment;
};

/// --probes, --probe-order, --rays, --seed and --env.
void addProbeOptions(CLI::App& app, ProbeOptions& options);

/// Writes probes or the volume of a bake into a folder. Throws UsageError where `output` is a file.
ExportReport exportAir(Session& session, const LoadedScene& loaded, const Bake& bake,
                       const std::filesystem::path& output, const std::string& name,
                       const ExportRequest& request, const ProbeOptions& options);

}  // namespace prelight::cli
