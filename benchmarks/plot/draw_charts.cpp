#include "benchmarks/plot/draw_charts.h"

#include <fstream>
#include <sstream>
#include <string>

#include "benchmarks/plot/python.h"
#include "benchmarks/run/work_folder.h"

namespace prelight::benchmarks {

namespace {

constexpr const char* chartLibrary = "matplotlib";

}  // namespace

bool canDrawCharts() { return !pythonWith(chartLibrary).empty(); }

std::vector<std::filesystem::path> drawCharts(const nlohmann::ordered_json& report,
                                              const std::filesystem::path& folder) {
  const WorkFolder work;
  const std::string file = work / "report.json";
  std::ofstream(file, std::ios::binary)
      << report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::istringstream printed(runScript(pythonWith(chartLibrary), "plot.py", {file, folder.string()}));
  std::vector<std::filesystem::path> files;
  for (std::string line; std::getline(printed, line);)
    if (const std::filesystem::path path = line; std::filesystem::exists(path)) files.push_back(path);
  return files;
}

}  // namespace prelight::benchmarks
