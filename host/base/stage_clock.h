#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace prelight {

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

}  // namespace prelight
