#pragma once

#include <cmath>
#include <vector>

#include "benchmarks/charts.h"

namespace prelight::benchmarks {

/// Maps positive numbers to pixels by their logarithm, a little beyond the least and the greatest of them.
class LogAxis {
 public:
  LogAxis(double min, double max, double from, double to)
      : min_(std::log(min / margin)), max_(std::log(max * margin)), from_(from), to_(to) {}

  double pixel(double value) const {
    return from_ + (to_ - from_) * (std::log(value) - min_) / (max_ - min_);
  }

  std::vector<double> ticks() const { return logTicks(std::exp(min_), std::exp(max_)); }

 private:
  static constexpr double margin = 1.15;
  double min_, max_, from_, to_;
};

}  // namespace prelight::benchmarks
