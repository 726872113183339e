#include "cli/commands/bench_report.h"

#include <fmt/format.h>

#include <utility>

#include "benchmarks/peers/embree/ray_peer.h"
#include "cli/commit.h"
#include "cli/output_file.h"

namespace prelight::cli {

namespace {

using Json = nlohmann::ordered_json;

std::string driverText(const DeviceInfo& device) {
  return fmt::format("{}, {}, driver {}", device.platform, device.platformVersion, device.driverVersion);
}

}  // namespace

BenchReport::BenchReport(std::filesystem::path file, const std::vector<benchmarks::ChosenPart>& parts,
                         const benchmarks::RunOptions& options, const DeviceInfo& device)
    : file_(std::move(file)) {
  Json optionsJson = {{"suites", Json::array()}, {"parts", Json::array()}, {"finished", Json::array()}};
  optionsJson.update(options.toJson());
  const std::string peer = benchmarks::embreeVersion();
  optionsJson["rayPeer"] = peer.empty() ? "none" : peer;
  for (const auto& [suite, part] : parts) {
    optionsJson["parts"].push_back(part);
    if (optionsJson.contains(suite->name())) continue;
    optionsJson["suites"].push_back(suite->name());
    optionsJson[suite->name()] = suite->toJson();
  }
  json_ = {{"version", PRELIGHT_VERSION},  {"commit", commit()},     {"device", device.name},
           {"driver", driverText(device)}, {"options", optionsJson}, {"results", Json::array()}};
  write();
}

void BenchReport::add(const std::string& suite, std::span<const benchmarks::BenchmarkResult> measured) {
  for (const benchmarks::BenchmarkResult& result : measured)
    json_["results"].push_back(toJson(suite, result));
  write();
}

void BenchReport::finish(const std::string& part) {
  json_["options"]["finished"].push_back(part);
  write();
}

void BenchReport::write() const {
  if (file_.empty()) return;
  writeTextFile(file_, json_.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace prelight::cli
