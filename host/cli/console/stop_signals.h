#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

namespace prelight::cli {

/// Handles SIGINT, SIGTERM and SIGHUP, the last one unless it was ignored at the start (nohup). While nothing
/// has to be finished, for example while files are read, the first signal ends the process at once, whatever
/// it waits for. Otherwise a scope says so: the first signal becomes a request to stop, and the process ends
/// if the request is not heard within two seconds. A second signal always ends it at once.
///
/// The signals are blocked in every thread and awaited by one. Handlers would not work: OpenCL compilers
/// replace them by their own, and the linkers that they start share the terminal and die of the same Ctrl-C,
/// which aborts PoCL. The object must be made before any other thread, which inherits the blocked signals.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  bool stopRequested() const { return requested_.load(std::memory_order_relaxed); }

  /// Sets the text that is printed if the process ends before the request was heard; empty: that no output
  /// was written.
  void setParting(std::string text);

  /// While such an object lives, a request to stop leaves time to save a state or to finish a file.
  class [[nodiscard]] SafePoints {
   public:
    explicit SafePoints(StopSignals& signals) : count_(signals.safePoints_) { ++count_; }
    ~SafePoints() { --count_; }
    SafePoints(const SafePoints&) = delete;
    SafePoints& operator=(const SafePoints&) = delete;

   private:
    std::atomic<int>& count_;
  };

  /// While such an object lives, files are renamed, which takes next to no time, and the process does not
  /// end.
  class [[nodiscard]] Writing {
   public:
    explicit Writing(StopSignals& signals) : count_(signals.writing_) { ++count_; }
    ~Writing() { --count_; }
    Writing(const Writing&) = delete;
    Writing& operator=(const Writing&) = delete;

   private:
    std::atomic<int>& count_;
  };

 private:
  void await();
  [[noreturn]] void end();
  bool mayEnd(std::chrono::steady_clock::duration sinceRequest) const;

  std::atomic<bool> requested_ = false;
  std::atomic<bool> done_ = false;
  std::atomic<int> safePoints_ = 0;
  std::atomic<int> writing_ = 0;
  std::mutex guard_;
  std::string parting_;  ///< guarded by guard_
  std::thread waiter_;
};

}  // namespace prelight::cli
