#pragma once

#include <cstdint>
#include <vector>

#include "benchmarks/suites/skip/setting.h"
#include "prelight/device.h"
#include "prelight/progress.h"

namespace prelight::benchmarks::skip {

/// Cost and result of a setting. Equal settings give equal outcomes, except for their time.
struct Outcome {
  std::uint64_t rays = 0;
  std::uint64_t launches = 0;     ///< launches of kernels
  std::uint64_t workItems = 0;    ///< work-items of all launches
  std::uint64_t deviceBytes = 0;  ///< bytes of all buffers that were made
  double cpuSeconds = 0.0;        ///< processor time on all cores, s, without reading and compiling the scene
  std::vector<float> values;      ///< all that was baked, or the picture
};

/// Bakes or draws. Throws as these do, and Interrupted.
Outcome carryOut(const Setting& setting, const Device& device, const Progress& progress);

/// Whether the values are the same to the bit.
bool sameValues(const Outcome& a, const Outcome& b);

}  // namespace prelight::benchmarks::skip
