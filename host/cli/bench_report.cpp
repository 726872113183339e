#include "cli/bench_report.h"

#include <fmt/format.h>

#include <utility>

#include "cli/commit.h"
#include "cli/output_file.h"

namespace prelight::cli {

namespace {

using Json = nlohmann::ordered_json;

std::string driverText(const DeviceInfo& device) {
  return fmt::format("{}, {}, driver {}", device.platform, device.platformVersion, device.driverVersion);
}

}  // namespace

BenchReport::BenchReport(std::filesystem::path file, const std::vector<std::string>& suites,
                         const benchmarks::BenchmarkOptions& options, const DeviceInfo& device)
    : file_(std::move(file)) {
  Json optionsJson = {{"suites", suites}, {"finished", Json::array()}};
  optionsJson.update(options.toJson());
  json_ = {{"version", PRELIGHT_VERSION},  {"commit", commit()},     {"device", device.name},
           {"driver", driverText(device)}, {"options", optionsJson}, {"results", Json::array()}};
  write();
}

void BenchReport::add(std::span<const benchmarks::BenchmarkResult> measured) {
  for (const benchmarks::BenchmarkResult& result : measured) {
    results_.push_back(result);
    json_["results"].push_back(toJson(result));
  }
  write();
}

void BenchReport::finish(const std::string& suite) {
  json_["options"]["finished"].push_back(suite);
  write();
}

void BenchReport::write() const {
  if (file_.empty()) return;
  writeTextFile(file_, json_.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace prelight::cli
