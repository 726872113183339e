#pragma once

#include <algorithm>
#include <barrier>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <latch>
#include <mutex>
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

/// Performs pieces of work one after the other in the order of their arrival, in a thread of its own. If the
/// system refuses a thread, add() performs the work.
class BackgroundWork {
 public:
  /// `waiting`: greatest number of pieces that wait while one is performed.
  explicit BackgroundWork(std::size_t waiting) : most_(waiting) {
    try {
      thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    } catch (const std::system_error&) {
    }
  }

  /// Pieces that have not begun are discarded.
  ~BackgroundWork() {
    thread_.request_stop();
    changed_.notify_all();
  }
  BackgroundWork(const BackgroundWork&) = delete;
  BackgroundWork& operator=(const BackgroundWork&) = delete;

  /// Returns the number of buffers with which, used in turns, the next piece finds one that no other piece
  /// uses.
  static constexpr std::size_t placesFor(std::size_t waiting) { return waiting + 2; }

  /// Adds a piece; blocks while too many others wait. Throws what an earlier piece threw.
  void add(std::function<void()> work) {
    if (!thread_.joinable()) return work();
    std::unique_lock lock(guard_);
    changed_.wait(lock, [&] { return pieces_.size() < most_ || failure_; });
    if (failure_) std::rethrow_exception(failure_);
    pieces_.push_back(std::move(work));
    changed_.notify_all();
  }

  /// Returns when all pieces are done. Throws what a piece threw.
  void finish() {
    std::unique_lock lock(guard_);
    changed_.wait(lock, [&] { return (pieces_.empty() && !busy_) || failure_; });
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void run(const std::stop_token& stop) {
    std::unique_lock lock(guard_);
    while (true) {
      changed_.wait(lock, [&] { return stop.stop_requested() || (!pieces_.empty() && !failure_); });
      if (stop.stop_requested()) return;
      const std::function<void()> work = std::move(pieces_.front());
      pieces_.pop_front();
      busy_ = true;
      lock.unlock();
      std::exception_ptr failure;
      try {
        work();
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      busy_ = false;
      if (failure) failure_ = failure;
      changed_.notify_all();
    }
  }

  std::size_t most_;
  std::mutex guard_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> pieces_;
  std::exception_ptr failure_;
  bool busy_ = false;
  std::jthread thread_;  ///< last, because it uses the others
};

}  // namespace prelight
