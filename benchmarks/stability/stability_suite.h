#pragma once

#include <string>
#include <vector>

#include "benchmarks/suite.h"

namespace prelight::benchmarks {

/// What of the suite `stability` is off by more than its bound, or not finite: a line each.
std::vector<std::string> brokenBounds(const std::vector<BenchmarkResult>& results);

}  // namespace prelight::benchmarks
