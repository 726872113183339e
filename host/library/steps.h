#pragma once

#include <functional>

#include "prelight/progress.h"

namespace prelight {

/// The steps that a call goes through, for those who time them. Between two of them it may be interrupted.
class Steps {
 public:
  /// The progress outlives it.
  explicit Steps(Progress& progress) : progress_(progress) {}
  virtual ~Steps() = default;
  Steps(const Steps&) = delete;
  Steps& operator=(const Steps&) = delete;

  /// Throws what the work throws, and Interrupted.
  void run(const char* name, const std::function<void()>& work) {
    measure(name, work);
    progress_.check();
  }

  Progress& progress() { return progress_; }

 private:
  virtual void measure(const char* /*name*/, const std::function<void()>& work) { work(); }

  Progress& progress_;
};

}  // namespace prelight
