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

/// Tells a Python function how far work is. Stops the work on Ctrl-C, on an exception from the function, when
/// it returns False, and when the interpreter is about to end. Work runs without the interpreter's lock,
/// which is taken a few times per second.
class PythonProgress final : public Progress {
 public:
  /// `told` is None or a function of a stage's name and a fraction.
  explicit PythonProgress(nb::object told) : told_(std::move(told)) {}

  void report(std::string_view stage, double fraction) override;
  void warn(std::string_view warning) override;
  bool stopRequested() const override;

  /// Throws the exception that Python raised meanwhile, if any.
  void rethrow() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// True a few times per second, in the calling thread.
  bool isDue() const;
  /// Lets Python handle signals, and tells it how far work is.
  void tell() const;

  nb::object told_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::string stage_ = "start";  ///< used only by the calling thread
  double fraction_ = 0.0;
  mutable Clock::time_point last_{};
  mutable std::exception_ptr raised_;
  mutable std::atomic<bool> stopped_ = false;
};

/// Passes a warning to Python's module `warnings`, from any thread. Throws if Python turns it into an
/// exception.
void warnInPython(std::string_view warning);

/// Does work without the interpreter's lock. An exception from Python takes precedence over the library's
/// Interrupted.
template <typename Work>
auto interruptibly(nb::object told, const Work& work) {
  PythonProgress progress(std::move(told));
  try {
    auto result = [&] {
      const UnlockedWork unlocked;
      return work(progress);
    }();
    progress.rethrow();  // an exception raised at the very end
    return result;
  } catch (const Interrupted&) {
    progress.rethrow();
    throw;
  }
}

}  // namespace prelight::python
