#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "prelight/progress.h"

namespace prelight::benchmarks {

/// A bake by a process of its own, so that time and memory are its alone.
struct BakeProcess {
  std::filesystem::path program;  ///< `prelight`
  std::filesystem::path scene;
  std::filesystem::path output;
  std::vector<std::string> options;  ///< arguments of `prelight bake`: techniques and effort
};

/// Time and results of such a process.
struct ProcessCost {
  bool finished = false;          ///< false: a signal ended it, as where memory was short
  double seconds = 0.0;           ///< from its start to its end
  double processorSeconds = 0.0;  ///< processor time of all its threads
  nlohmann::ordered_json report;  ///< the file of `--report`; null where it did not finish
  std::uint64_t outputBytes = 0;
};

/// Runs it to its end. Where memory is short, the system ends this process first. Throws Interrupted after
/// having ended it, and Error, with the end of what it printed, when it fails.
ProcessCost runBakeProcess(const BakeProcess& bake, const Progress& progress);

}  // namespace prelight::benchmarks
