#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace prelight {

std::size_t hardwareThreads() { return std::max(1u, std::thread::hardware_concurrency()); }

void parallelRanges(std::size_t count, std::size_t grain,
                    const std::function<void(std::size_t begin, std::size_t end)>& work,
                    std::size_t threads) {
  const std::size_t ranges = (count + grain - 1) / grain;
  std::atomic<std::size_t> next = 0;
  std::mutex guard;
  std::exception_ptr failure;
  const auto run = [&] {
    try {
      for (std::size_t r = next++; r < ranges; r = next++) work(r * grain, std::min(count, (r + 1) * grain));
    } catch (...) {
      next = ranges;  // no thread takes another range
      const std::lock_guard lock(guard);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (std::size_t t = 1; t < std::min(threads, ranges); ++t) others.emplace_back(run);
    } catch (const std::system_error&) {
    }
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace prelight
