#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>

namespace prelight {

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
