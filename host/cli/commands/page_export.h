#pragma once

#include <nlohmann/json.hpp>

#include "cli/commands/export_options.h"
#include "cli/session.h"

namespace prelight::cli {

/// Writes one .html in which the scene can be relit, for `export --target web`. Returns its part of the
/// report.
nlohmann::ordered_json exportPage(Session& session, const ExportOptions& options, const LoadedScene& loaded,
                                  const Bake& bake);

}  // namespace prelight::cli
