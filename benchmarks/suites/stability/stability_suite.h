#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Options of the suite `stability`; its table says what each means.
struct StabilityOptions : RunOptions {
  std::vector<int> orders;
  std::vector<int> faceSizes;
  std::vector<int> skyRows;
  std::vector<int> elementCells;
  std::size_t rays;
  std::size_t lights;
  std::uint64_t photons;
  std::uint64_t flownPhotons;
  std::vector<std::size_t> densityPhotons;
  std::uint64_t bakeRays;
  std::vector<std::string> scenes;

  static const OptionTable<StabilityOptions>& table();

  /// Replaces the suite's own values by those of the command line.
  void takeGiven();
};

/// Errors of every kernel and basis on hard inputs, compared with double precision and closed forms, and the
/// bounds that they must keep. Writes its tables into options.folder.
void runStability(const Device& device, const StabilityOptions& options, SuiteRun& run);

/// Returns whether RunOptions::onlyCase leaves it a case.
bool hasStabilityCase(const StabilityOptions& options);

/// Returns a sentence for each bound that the results break.
std::vector<std::string> brokenBounds(std::span<const BenchmarkResult> results);

std::unique_ptr<Suite> stabilitySuite();

}  // namespace prelight::benchmarks
