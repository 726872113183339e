#include "gi/update/frame_budget.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace prelight {

namespace {

/// Seconds per item on two cores of a Xeon at 2.5 GHz, [kind].
constexpr std::array<double, 3> usualCosts = {7e-6, 3.3e-6, 2.2e-7};

/// Fewer items than this tell nothing about their cost.
constexpr std::uint64_t tellingItems = 64;

/// Costs change by this factor per frame at most, so that one slow frame, which builds a program for example,
/// does not starve later ones.
constexpr double mostChange = 1.5;

}  // namespace

FrameBudget::FrameBudget(double seconds, Clock clock)
    : seconds_(seconds), clock_(std::move(clock)), costs_(usualCosts) {}

void FrameBudget::begin() {
  left_ = seconds_;
  if (clock_) last_ = clock_();
}

std::uint32_t FrameBudget::affordable(FrameWork kind) const {
  if (seconds_ <= 0.0) return unlimited;
  const double items = left_ / costs_[static_cast<std::size_t>(kind)];
  return static_cast<std::uint32_t>(
      std::clamp(items, static_cast<double>(leastItems), static_cast<double>(unlimited - 1)));
}

double FrameBudget::elapsed() {
  const double now = clock_();
  return now - std::exchange(last_, now);
}

void FrameBudget::spend(FrameWork kind, std::uint64_t items) {
  double& cost = costs_[static_cast<std::size_t>(kind)];
  const auto count = static_cast<double>(items);
  if (!clock_) {
    left_ -= cost * count;
    return;
  }
  const double seconds = elapsed();
  left_ -= seconds;
  if (items >= tellingItems)
    cost = std::clamp(0.5 * (cost + seconds / count), cost / mostChange, cost * mostChange);
}

void FrameBudget::spend() {
  if (clock_) left_ -= elapsed();
}

}  // namespace prelight
