#include <fmt/format.h>

#include <cmath>

#include "benchmarks/charts.h"

namespace prelight::benchmarks {

namespace {

/// Nearest power of ten at or below a number > 0, as an exponent; rounding does not lose one.
int decade(double value) { return static_cast<int>(std::floor(std::log10(value) + 1e-9)); }

}  // namespace

std::vector<double> linearTicks(double min, double max, double count) {
  const double power = std::pow(10.0, decade((max - min) / count));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power * count >= (max - min) * (1.0 - 1e-9)) step = factor * power;
  std::vector<double> ticks;
  const auto first = static_cast<int>(std::ceil(min / step - 1e-9));
  for (int i = first; i * step <= max + 1e-9 * step; ++i) ticks.push_back(i * step);
  return ticks;
}

std::vector<double> logTicks(double min, double max) {
  constexpr int mostTicks = 8;
  if (max < 10.0 * min) return max > min ? linearTicks(min, max, 6.0) : std::vector<double>{min};
  const bool between = max < 1000.0 * min;  // 2 and 5 times powers of ten as well
  const int first = decade(min), last = decade(max);
  const int step = (last - first) / mostTicks + 1;
  std::vector<double> ticks;
  for (int exponent = first; exponent <= last; exponent += step)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * std::pow(10.0, exponent);
      if ((between || factor < 2.0) && tick >= min * (1.0 - 1e-9) && tick <= max * (1.0 + 1e-9))
        ticks.push_back(tick);
    }
  return ticks;
}

std::string tickText(double tick) {
  if (tick >= 1e6) return fmt::format("{:.6g} M", tick * 1e-6);
  if (tick >= 1e4) return fmt::format("{:.6g} k", tick * 1e-3);
  if (tick <= 0.0 || tick >= 1e-3 * (1.0 - 1e-9)) return fmt::format("{:.6g}", tick);
  const int exponent = decade(tick);
  return fmt::format("{:.3g}e{}", tick / std::pow(10.0, exponent), exponent);
}

}  // namespace prelight::benchmarks
