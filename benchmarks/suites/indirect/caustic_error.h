#pragma once

#include <vector>

#include "benchmarks/suites/indirect/indirect_suite.h"
#include "prelight/device.h"
#include "prelight/progress.h"

namespace prelight::benchmarks {

/// Error and processor time of filters of a caustic in closed form, by the number of photons: "caustic/100k/k
/// 50". relMSE is over the pixels of a picture of the floor, against its irradiance averaged over each.
void measureCaustic(const Device& device, const IndirectOptions& options,
                    std::vector<BenchmarkResult>& results);

}  // namespace prelight::benchmarks
