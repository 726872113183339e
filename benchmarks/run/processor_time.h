#pragma once

#include <ctime>

namespace prelight::benchmarks {

/// Processor time of this process so far, all threads together, s.
inline double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace prelight::benchmarks
