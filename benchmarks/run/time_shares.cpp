#include "benchmarks/run/time_shares.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace prelight::benchmarks {

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Deadline::Deadline(double seconds, SecondsSource clock)
    : clock_(std::move(clock)), end_(clock_() + seconds) {}

double Deadline::left() const { return std::max(0.0, end_ - clock_()); }

TimeShares::TimeShares(double seconds, double weights, SecondsSource clock)
    : deadline_(seconds, std::move(clock)), weights_(weights) {}

double TimeShares::next(double weight) {
  const double share = weights_ > 0.0 ? left() * std::min(1.0, weight / weights_) : left();
  weights_ = std::max(0.0, weights_ - weight);
  return share;
}

}  // namespace prelight::benchmarks
