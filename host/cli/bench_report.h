#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/suite.h"
#include "prelight/device.h"

namespace prelight::cli {

/// The results of `bench` so far. The file is written anew whenever there are more results, so that it is
/// complete and valid at every moment, however a run ends.
class BenchReport {
 public:
  /// Writes no file if `file` is empty.
  BenchReport(std::filesystem::path file, const std::vector<std::string>& suites,
              const benchmarks::BenchmarkOptions& options, const DeviceInfo& device);

  void add(std::span<const benchmarks::BenchmarkResult> measured);

  /// Records that a suite has been measured to its end.
  void finish(const std::string& suite);

  const std::vector<benchmarks::BenchmarkResult>& results() const { return results_; }
  const nlohmann::ordered_json& json() const { return json_; }

 private:
  void write() const;

  std::filesystem::path file_;
  std::vector<benchmarks::BenchmarkResult> results_;
  nlohmann::ordered_json json_;
};

}  // namespace prelight::cli
