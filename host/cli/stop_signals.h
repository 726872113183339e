#pragma once

#include <atomic>
#include <thread>

namespace prelight::cli {

/// Turns the first SIGINT or SIGTERM into a request to stop; a second one ends the process at once.
///
/// The signals are blocked in every thread and awaited by one. A handler would not do: OpenCL compilers put
/// handlers of their own in its place, and the linkers they start share the terminal and die of the same
/// Ctrl-C, which aborts PoCL. Make it before any other thread, which inherits what is blocked.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  bool stopRequested() const { return requested_.load(std::memory_order_relaxed); }

  /// From now on the first signal ends the process at once: nothing is left that has to be finished.
  void endAtOnce() { immediate_.store(true); }

 private:
  void await();

  std::atomic<bool> requested_ = false;
  std::atomic<bool> immediate_ = false;
  std::atomic<bool> done_ = false;
  std::thread waiter_;
};

}  // namespace prelight::cli
