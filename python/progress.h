#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "prelight/progress.h"
#include "python/unlocked_work.h"

namespace prelight::python {

namespace nb = nanobind;

/// Tells a Python function how far work is, and stops it on Ctrl-C, on what the function raises, when it
/// returns False and when the interpreter is about to end. Work runs without the interpreter's lock, which is
/// taken a few times a second.
class PythonProgress final : public Progress {
 public:
  /// `told` is None or takes a stage's name and a fraction.
  explicit PythonProgress(nb::object told) : told_(std::move(told)) {}

  void report(std::string_view stage, double fraction) override;
  void warn(std::string_view warning) override;
  bool stopRequested() const override;

  /// Throws what Python raised meanwhile, if it did.
  void rethrow() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// True a few times a second, in the thread that called.
  bool isDue() const;
  /// Lets Python handle signals, and tells it where work is.
  void tell() const;

  nb::object told_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::string stage_ = "start";  ///< the calling thread alone knows what follows
  double fraction_ = 0.0;
  mutable Clock::time_point last_{};
  mutable std::exception_ptr raised_;
  mutable std::atomic<bool> stopped_ = false;
};

/// Hands a warning to Python's module `warnings`, from whatever thread. Throws what Python makes of it.
void warnInPython(std::string_view warning);

/// Does work without the interpreter's lock. What Python raised goes before the library's Interrupted.
template <typename Work>
auto interruptibly(nb::object told, const Work& work) {
  PythonProgress progress(std::move(told));
  try {
    auto result = [&] {
      const UnlockedWork unlocked;
      return work(progress);
    }();
    progress.rethrow();  // what was raised at the very end
    return result;
  } catch (const Interrupted&) {
    progress.rethrow();
    throw;
  }
}

}  // namespace prelight::python
