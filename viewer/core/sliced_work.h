#pragma once

#include <coroutine>
#include <exception>
#include <utility>

namespace prelight::viewer {

/// Work that pauses between slices, so that its caller can do something else meanwhile: a coroutine that
/// awaits `endOfSlice`. What it refers to has to outlive it. Destroying it abandons what is left.
class SlicedWork {
 public:
  struct promise_type {
    SlicedWork get_return_object() {
      return SlicedWork(std::coroutine_handle<promise_type>::from_promise(*this));
    }
    std::suspend_always initial_suspend() const noexcept { return {}; }
    std::suspend_always final_suspend() const noexcept { return {}; }
    void return_void() const noexcept {}
    void unhandled_exception() noexcept { error = std::current_exception(); }

    std::exception_ptr error;
  };

  SlicedWork(SlicedWork&& other) noexcept : work_(std::exchange(other.work_, nullptr)) {}
  SlicedWork& operator=(SlicedWork&& other) noexcept {
    std::swap(work_, other.work_);
    return *this;
  }
  SlicedWork(const SlicedWork&) = delete;
  SlicedWork& operator=(const SlicedWork&) = delete;
  ~SlicedWork() {
    if (work_ != nullptr) work_.destroy();
  }

  /// Does the next slice. Returns false when nothing is left to do. Throws what the work throws.
  bool goOn() {
    if (work_.done()) return false;
    work_.resume();
    if (work_.promise().error) std::rethrow_exception(std::exchange(work_.promise().error, nullptr));
    return !work_.done();
  }

  void finish() {
    while (goOn()) {
    }
  }

 private:
  explicit SlicedWork(std::coroutine_handle<promise_type> work) : work_(work) {}

  std::coroutine_handle<promise_type> work_;
};

/// Awaited by work at the end of a slice.
constexpr std::suspend_always endOfSlice{};

}  // namespace prelight::viewer
