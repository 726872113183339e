#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/catalogue.h"
#include "prelight/device.h"

namespace prelight::cli {

/// The results of `bench` so far. The file is written anew whenever there are more results, so that it is
/// complete and valid at every moment, however a run ends.
class BenchReport {
 public:
  /// Writes no file if `file` is empty.
  BenchReport(std::filesystem::path file, const std::vector<benchmarks::ChosenPart>& parts,
              const benchmarks::RunOptions& options, const DeviceInfo& device);

  /// Adds results of a suite.
  void add(const std::string& suite, std::span<const benchmarks::BenchmarkResult> measured);

  /// Records that a part of a suite has been measured to its end.
  void finish(const std::string& part);

  const nlohmann::ordered_json& json() const { return json_; }

 private:
  void write() const;

  std::filesystem::path file_;
  nlohmann::ordered_json json_;
};

}  // namespace prelight::cli
