#include "bake/saving_progress.h"

#include <algorithm>
#include <utility>

namespace prelight {

namespace {

constexpr double firstShare = 1.0 / 6.0;  // of the interval
constexpr double leastRatio = 100.0;      // of the time between saves to that of one

std::chrono::steady_clock::duration duration(double seconds) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(seconds));
}

}  // namespace

SavingProgress::SavingProgress(Progress& outer, double interval, double expected, std::function<void()> save)
    : outer_(outer),
      interval_(interval),
      save_(std::move(save)),
      wait_(interval * firstShare),
      next_(Clock::now() + duration(interval > 0.0 ? std::max(wait_, leastRatio * expected) : 0.0)) {}

bool SavingProgress::stopRequested() const {
  if (outer_.stopRequested()) return true;
  const Clock::time_point start = Clock::now();
  if (start < next_) return false;
  save_();
  const Clock::time_point end = Clock::now();
  wait_ = std::min(2.0 * wait_, interval_);
  next_ =
      interval_ > 0.0 ? end + std::max(duration(wait_), (end - start) * static_cast<int>(leastRatio)) : end;
  return false;
}

}  // namespace prelight
