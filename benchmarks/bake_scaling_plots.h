#pragma once

#include <string>
#include <vector>

#include "benchmarks/suite.h"

/// Charts of `bake-scaling`, as SVG.
namespace prelight::benchmarks {

/// Seconds of every stage of the largest request, over triangles.
std::string bakeStagesPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// How much longer bakes take than their rays alone, over rays a vertex.
std::string bakeSharePlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Peak memory and the plans' estimates, over triangles.
std::string bakeMemoryPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Error of SH over seconds, beside another baker's.
std::string bakeErrorPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

}  // namespace prelight::benchmarks
