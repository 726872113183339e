#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/run/suite.h"

namespace prelight::benchmarks {

/// Options of the suite `techniques`; its table says what each means.
struct TechniquesOptions : RunOptions {
  std::vector<std::string> scenes;
  std::uint64_t rays;
  std::uint64_t crowdRays;
  int order;
  int haarSize;
  int width;
  int height;
  std::uint64_t samples;
  int frames;
  int objects;
  int lights;
  int skyRows;
  std::vector<std::size_t> lightCounts;

  static const OptionTable<TechniquesOptions>& table();

  /// Replaces the suite's own values by those that the command line gives.
  void takeGiven();
};

/// Every technique's seconds and bytes, its frames per second, and the difference of its pictures from
/// path-traced ones, beside the numbers of Sherif's thesis (2013, Table 7.1). Writes tables and pictures into
/// options.folder. Needs OpenGL.
void runTechniques(const Device& device, const TechniquesOptions& options, SuiteRun& run);

std::unique_ptr<Suite> techniquesSuite();

}  // namespace prelight::benchmarks
