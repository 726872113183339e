#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace prelight::benchmarks {

/// Whether a Python with matplotlib is there, which draws the charts.
bool canDrawCharts();

/// Draws the charts of a report of `bench` into a folder that exists, which may hold pictures of suites.
/// Returns the files written. Throws Error where the script fails.
std::vector<std::filesystem::path> drawCharts(const nlohmann::ordered_json& report,
                                              const std::filesystem::path& folder);

}  // namespace prelight::benchmarks
