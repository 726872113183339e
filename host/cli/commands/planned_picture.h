#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/console/console.h"
#include "cli/work_estimate.h"
#include "prelight/picture.h"
#include "prelight/plan.h"

namespace prelight::cli {

/// The contents of --dry-run for a picture.
struct PlannedPicture {
  std::filesystem::path output = {};
  int width = 0, height = 0;
  std::string how = {};  ///< such as "path integrator, 256 samples per pixel"
  std::vector<PlannedPass> plan = {};
  std::uint64_t bytes = 0;  ///< approximate size of the output
  DeviceInfo device = {};
  /// None: the work ends after a given time, or cannot be estimated
  std::optional<WorkEstimate> estimate = {};
  std::string time = {};  ///< text instead of an estimate, or a remark about it
};

/// Returns the size that a picture's file would have.
std::uint64_t encodedBytes(const std::filesystem::path& path, const Picture& picture,
                           const std::vector<PictureChannel>& channels = {});

void printPlannedPicture(const Console& console, const PlannedPicture& planned);

/// Adds the plan to a command's report.
void addPlannedPicture(const PlannedPicture& planned, nlohmann::ordered_json& report);

}  // namespace prelight::cli
