#pragma once

#include <string>
#include <vector>

#include "benchmarks/suites/stability/trials.h"

namespace prelight::benchmarks::stability {

/// The worst of every subject's trials, by the share of its bound.
std::string worstTable(const std::vector<Trial>& trials);

/// Worst relative errors of bases by order.
std::string orderTable(const std::vector<Trial>& trials);

/// Which kernel is run by which subject.
std::string kernelTable();

/// Tables of all trials on a device, as Markdown.
std::string makeReport(const std::vector<Trial>& trials, const std::string& device);

}  // namespace prelight::benchmarks::stability
