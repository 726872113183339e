#pragma once

#include <functional>

#include "prelight/progress.h"

namespace prelight {

/// The steps of a call, which derived classes may time. A call may be interrupted between steps.
class Steps {
 public:
  /// The progress must outlive the object.
  explicit Steps(Progress& progress) : progress_(progress) {}
  virtual ~Steps() = default;
  Steps(const Steps&) = delete;
  Steps& operator=(const Steps&) = delete;

  /// Runs a step. Throws what the work throws, and Interrupted.
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
