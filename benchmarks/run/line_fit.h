#pragma once

#include <span>

namespace prelight::benchmarks {

struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// y = intercept + slope x.
struct LineFit {
  double intercept = 0.0;
  double slope = 0.0;
  double r2 = 0.0;  ///< share of the variance of y that the line explains; 1 where there is none to explain
};

/// Least squares. There must be two different x.
LineFit fitLine(std::span<const Point> points);

}  // namespace prelight::benchmarks
