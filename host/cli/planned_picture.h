#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.h"
#include "cli/work_estimate.h"
#include "prelight/picture.h"
#include "prelight/plan.h"

namespace prelight::cli {

/// What --dry-run tells of a picture.
struct PlannedPicture {
  std::filesystem::path output = {};
  int width = 0, height = 0;
  std::string how = {};  ///< "path integrator, 256 samples a pixel"
  std::vector<PlannedPass> plan = {};
  std::uint64_t bytes = 0;  ///< of the output, about
  DeviceInfo device = {};
  std::optional<WorkEstimate> estimate = {};  ///< none: it ends after a time, or cannot be known
  std::string time = {};                      ///< in place of an estimate; or what it rests on
};

/// What a picture's file would take.
std::uint64_t encodedBytes(const std::filesystem::path& path, const Picture& picture,
                           const std::vector<PictureChannel>& channels = {});

void printPlannedPicture(const Console& console, const PlannedPicture& planned);

/// Adds what is planned to a command's report.
void addPlannedPicture(const PlannedPicture& planned, nlohmann::ordered_json& report);

}  // namespace prelight::cli
