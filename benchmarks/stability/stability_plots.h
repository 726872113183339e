#pragma once

#include <string>
#include <vector>

#include "benchmarks/suite.h"

/// Charts of the suite `stability`: worst relative errors against what they grow with.
namespace prelight::benchmarks {

std::string stabilityOrderPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Against the number of what is added up: rays, photons, lights, elements, components.
std::string stabilityCountPlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

/// Against sizes of cube maps and skies.
std::string stabilitySizePlot(const std::vector<BenchmarkResult>& results, const std::string& subtitle);

}  // namespace prelight::benchmarks
