#pragma once

#include <algorithm>
#include <barrier>
#include <cstddef>
#include <functional>
#include <latch>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include "base/parallel.h"

namespace prelight {

/// One of several threads that perform the same steps side by side.
class TeamMember {
 public:
  TeamMember(std::size_t number, std::size_t size, std::barrier<>& barrier)
      : number_(number), size_(size), barrier_(barrier) {}

  /// Calls work(begin, end) for this member's share of the ranges of `grain` that cover [0, count). The
  /// ranges depend only on `grain`.
  template <typename Work>
  void ranges(std::size_t count, std::size_t grain, const Work& work) const {
    const std::size_t ranges = (count + grain - 1) / grain;
    const std::size_t last = ranges * (number_ + 1) / size_;
    for (std::size_t r = ranges * number_ / size_; r < last; ++r)
      work(r * grain, std::min(count, (r + 1) * grain));
  }

  /// Returns true for the member that works in the calling thread of runTeam().
  bool isFirst() const { return number_ == 0; }

  /// Blocks until all members have called it.
  void wait() const { barrier_.arrive_and_wait(); }

 private:
  std::size_t number_;
  std::size_t size_;
  std::barrier<>& barrier_;
};

/// Has `work` done by a team of up to `threads` threads, fewer if the system refuses them. Cheaper than
/// parallelRanges() for many short steps in a row. `work` must not throw.
inline void runTeam(std::size_t threads, const std::function<void(const TeamMember&)>& work) {
  std::latch complete(1);
  std::optional<std::barrier<>> barrier;
  std::size_t size = 1;
  std::vector<std::jthread> others;
  try {
    for (std::size_t t = 1; t < threads; ++t)
      others.emplace_back([&, t] {
        complete.wait();
        work(TeamMember(t, size, *barrier));
      });
  } catch (const std::system_error&) {
  }
  size += others.size();
  barrier.emplace(static_cast<std::ptrdiff_t>(size));
  complete.count_down();
  work(TeamMember(0, size, *barrier));
}

}  // namespace prelight
