#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/suite.h"
#include "prelight/device.h"

namespace prelight::cli {

/// What `bench` has measured. Its file is written anew whenever there is more, so that it is whole and valid
/// at every moment, however a run ends.
class BenchReport {
 public:
  /// `file` empty: none is written.
  BenchReport(std::filesystem::path file, const std::vector<std::string>& suites,
              const benchmarks::BenchmarkOptions& options, const DeviceInfo& device);

  void add(std::span<const benchmarks::BenchmarkResult> measured);

  /// A suite has been measured to its end.
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
