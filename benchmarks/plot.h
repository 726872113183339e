#pragma once

#include <string>
#include <vector>

#include "benchmarks/suite.h"

namespace prelight::benchmarks {

struct Plot {
  std::string name;  ///< begins with the suite's; a file name without extension
  std::string svg;
};

/// Charts of each suite that has results. `subtitle` says where they were measured.
std::vector<Plot> makePlots(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

}  // namespace prelight::benchmarks
