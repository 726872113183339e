#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace prelight {

/// Seconds since some moment, by a clock that never goes back.
inline double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Records the time since the last mark under a name; consecutive marks of one name add up.
class StageClock {
 public:
  /// `seconds` must outlive this object.
  explicit StageClock(std::vector<std::pair<std::string, double>>& seconds) : seconds_(seconds) {}

  void restart() { last_ = Clock::now(); }

  void mark(const std::string& stage) {
    const auto now = Clock::now();
    if (seconds_.empty() || seconds_.back().first != stage) seconds_.emplace_back(stage, 0.0);
    seconds_.back().second += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::vector<std::pair<std::string, double>>& seconds_;
  Clock::time_point last_ = Clock::now();
};

/// Chooses how many items of work to process at once, so that about a quarter of a second passes between two
/// tests for interruption. For work whose results do not depend on that number.
class Pace {
 public:
  /// Numbers are multiples of `least` items, and at most `most`.
  Pace(std::size_t least, std::size_t most) : least_(least), most_(std::max(least, most)), count_(least) {}

  /// Returns the next number, at most `left`. The time since the last call counts as that of the items that
  /// it returned.
  std::size_t next(std::size_t left) {
    const Clock::time_point now = Clock::now();
    if (begun_ && now - last_ < shortest) count_ = std::min(2 * count_, most_);
    if (begun_ && now - last_ > longest) count_ = std::max(count_ / 2 / least_ * least_, least_);
    begun_ = true;
    last_ = now;
    return std::min(count_, left);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto shortest = std::chrono::milliseconds(125), longest = std::chrono::milliseconds(500);

  std::size_t least_, most_, count_;
  Clock::time_point last_;
  bool begun_ = false;
};

}  // namespace prelight
