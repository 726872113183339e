#pragma once

#include "cli/commands/export_options.h"
#include "cli/session.h"
#include "export/export_bake.h"

namespace prelight::cli {

/// Writes the probes or the volume of a bake into a folder. Throws UsageError if the output is a file.
ExportReport exportAir(Session& session, const ExportOptions& options, const ExportRequest& request,
                       const LoadedScene& loaded, const Bake& bake);

}  // namespace prelight::cli
