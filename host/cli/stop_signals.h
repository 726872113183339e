#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

namespace prelight::cli {

/// Answers SIGINT, SIGTERM and, unless whoever started the program has it ignored (nohup), SIGHUP. Where
/// nothing has to be finished, as while files are read, the first of them ends the process at once, whatever
/// it waits for. Where something has, a scope says so: the first becomes a request to stop, and the process
/// ends when that has not been heard within two seconds. A second one always ends it at once.
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

  /// What is said when the process ends before the request was heard; empty: that nothing was written.
  void setParting(std::string text);

  /// While one of them lives, a request leaves a moment: to come to where what is done is kept, or to finish
  /// a file.
  class [[nodiscard]] SafePoints {
   public:
    explicit SafePoints(StopSignals& signals) : count_(signals.safePoints_) { ++count_; }
    ~SafePoints() { --count_; }
    SafePoints(const SafePoints&) = delete;
    SafePoints& operator=(const SafePoints&) = delete;

   private:
    std::atomic<int>& count_;
  };

  /// While one of them lives, files move to their places, which takes next to no time, and the process does
  /// not end.
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
  std::string parting_;  ///< guarded
  std::thread waiter_;
};

}  // namespace prelight::cli
