#pragma once

#include <vector>

#include "benchmarks/suite.h"

namespace prelight::benchmarks {

/// Processor time that vector occluders add to a bake of AO on `shapes`, in turns with it.
void measureOccluderBake(const Device& device, const BenchmarkOptions& options, Progress& progress,
                         std::vector<BenchmarkResult>& results);

/// Processor time of shading many vertices by growing numbers of lights, and the line through it.
void measureOccluderShading(const Device& device, const BenchmarkOptions& options, Progress& progress,
                            std::vector<BenchmarkResult>& results);

}  // namespace prelight::benchmarks
