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

  /// Replaces the suite's own values by those of the command line.
  void takeGiven();
};

/// Seconds, bytes, frames per second and error of every technique, compared with path-traced pictures and
/// beside the numbers of Sherif's thesis (2013, Table 7.1). Writes tables and pictures into options.folder.
/// Needs OpenGL.
void runTechniques(const Device& device, const TechniquesOptions& options, SuiteRun& run);

std::unique_ptr<Suite> techniquesSuite();

}  // namespace prelight::benchmarks
