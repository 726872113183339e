#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace prelight {

/// Texts of the Python scripts by path under benchmarks/ ("plot/plot.py").
const std::map<std::string, std::string>& plotScripts();

}  // namespace prelight

namespace prelight::benchmarks {

/// Returns a Python 3 that can import a module: that of PATH, or else the system's; empty if neither can.
std::string pythonWith(const std::string& module);

/// Runs a script of benchmarks/plot/, such as "plot.py". Returns what it printed. If it fails, throws Error
/// with the end of that.
std::string runScript(const std::string& python, const std::string& script,
                      const std::vector<std::string>& arguments);

/// Returns whether there is a Python with matplotlib, which draws the charts.
bool canDrawCharts();

/// Draws the charts of a report of `bench` into an existing folder, which may hold pictures of suites.
/// Returns the files written. Throws Error if the script fails.
std::vector<std::filesystem::path> drawCharts(const nlohmann::ordered_json& report,
                                              const std::filesystem::path& folder);

}  // namespace prelight::benchmarks
