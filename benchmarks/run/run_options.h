#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace prelight::benchmarks {

/// Values of the command line that take the place of some suites' own. Each suite's take() says which it
/// uses.
struct GivenValues {
  std::optional<std::uint64_t> rays;        ///< per vertex
  std::optional<std::uint64_t> samples;     ///< per pixel of path-traced pictures
  std::optional<std::uint64_t> photons;     ///< per room of `stability`
  std::optional<std::pair<int, int>> size;  ///< width and height of pictures, pixels
  std::vector<std::string> models = {};     ///< glTF files to measure besides a suite's own scenes
};

/// Options of a run that every suite has.
struct RunOptions {
  bool quick = false;           ///< so little that every suite ends within seconds; its numbers mean nothing
  int runs = 5;                 ///< runs of each case, >= 1, after one that warms up
  double suiteSeconds = 540.0;  ///< time that `viewer`, `gather` and `techniques` take each, about
  std::string onlyCase = {};    ///< only cases whose names contain this; empty: all
  std::filesystem::path folder = {};   ///< where suites write tables and pictures; empty: nowhere
  std::filesystem::path truths = {};   ///< where `techniques` keeps its path-traced pictures; empty: nowhere
  std::filesystem::path program = {};  ///< `prelight`, which `bake-scaling` runs
  std::vector<std::filesystem::path> skies = {};  ///< .hdr or .exr, used by `wavelets` and `techniques`
  GivenValues given = {};

  /// Options of a run that shows within seconds that the suites work.
  static RunOptions quickRun();

  nlohmann::ordered_json toJson() const;
};

}  // namespace prelight::benchmarks
