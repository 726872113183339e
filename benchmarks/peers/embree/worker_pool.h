#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace prelight::benchmarks {

/// Threads that wait between the rounds of a measurement, so that rounds do not include starting them.
class WorkerPool {
 public:
  using Work = std::function<void(std::size_t begin, std::size_t end)>;

  /// `threads` (>= 1) includes the thread that calls run().
  explicit WorkerPool(std::size_t threads);
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();

  std::size_t threads() const { return others_.size() + 1; }

  /// Divides [0, count) into ranges of `grain` elements, gives them to free threads, and returns when all are
  /// done. `work` must not throw.
  void run(std::size_t count, std::size_t grain, const Work& work);

 private:
  void serve();
  void takeRanges();

  std::mutex mutex_;
  std::condition_variable wake_, done_;
  const Work* work_ = nullptr;
  std::size_t count_ = 0;
  std::size_t grain_ = 1;
  std::atomic<std::size_t> next_{0};
  std::size_t round_ = 0;
  std::size_t busy_ = 0;
  bool stop_ = false;
  std::vector<std::thread> others_;
};

}  // namespace prelight::benchmarks
