#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace prelight {

/// Threads that the machine runs at once, at least 1.
inline std::size_t hardwareThreads() { return std::max(1u, std::thread::hardware_concurrency()); }

/// Calls work(begin, end) for consecutive ranges that cover [0, count), on all cores. The ranges depend on
/// `grain` alone, never on the number of threads, so that sums over ranges are reproducible. `work` must not
/// throw.
inline void parallelRanges(std::size_t count, std::size_t grain,
                           const std::function<void(std::size_t begin, std::size_t end)>& work) {
  const std::size_t ranges = (count + grain - 1) / grain;
  const std::size_t threads = std::min(hardwareThreads(), ranges);
  const auto run = [&](std::size_t first) {
    for (std::size_t r = first; r < ranges; r += threads) work(r * grain, std::min(count, (r + 1) * grain));
  };
  std::vector<std::jthread> others;
  for (std::size_t t = 1; t < threads; ++t) others.emplace_back(run, t);
  if (ranges > 0) run(0);
}

}  // namespace prelight
