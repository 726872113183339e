#pragma once

#include <nlohmann/json.hpp>

#include "cli/export_options.h"
#include "cli/session.h"

namespace prelight::cli {

/// `export --target web`: writes one .html that relights the scene. Returns what a report says of it.
nlohmann::ordered_json exportPage(Session& session, const ExportOptions& options, const LoadedScene& loaded,
                                  const Bake& bake);

}  // namespace prelight::cli
