#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/commands/bake_estimate.h"
#include "cli/console/console.h"
#include "prelight/techniques.h"

namespace prelight::cli {

/// The contents of --dry-run for a bake.
struct PlannedBake {
  const std::filesystem::path& output;
  const BakeRequest& request;
  std::uint64_t bytes = 0;  ///< size of the output
  bool animated = false;    ///< the keys of an animation are baked, too
};

void printPlannedBake(const Console& console, const PlannedBake& planned, const BakeEstimate& estimate);

nlohmann::ordered_json plannedBakeReport(const PlannedBake& planned, const BakeEstimate& estimate,
                                         const LoadedScene& loaded, Session& session);

}  // namespace prelight::cli
