#include "python/progress.h"

#include <string>

namespace prelight::python {

namespace {

constexpr auto pause = std::chrono::milliseconds(50);

}  // namespace

bool PythonProgress::isDue(Clock::time_point& last) const {
  if (std::this_thread::get_id() != caller_) return false;
  const Clock::time_point now = Clock::now();
  if (now - last < pause) return false;
  last = now;
  return true;
}

void PythonProgress::stopBy(std::exception_ptr raised) const {
  if (!raised_) raised_ = std::move(raised);
  stopped_ = true;
}

void PythonProgress::askSignals() const {
  try {
    if (PyErr_CheckSignals() != 0) nb::raise_python_error();
  } catch (...) {
    stopBy(std::current_exception());
  }
}

void PythonProgress::report(std::string_view stage, double fraction) {
  if (told_.is_none() || stopped_ || !isDue(lastReport_)) return;
  const nb::gil_scoped_acquire acquired;
  try {
    const nb::object answer = told_(std::string(stage).c_str(), fraction);
    if (answer.ptr() == Py_False) stopped_ = true;
  } catch (...) {
    stopBy(std::current_exception());
  }
}

bool PythonProgress::stopRequested() const {
  if (!stopped_ && isDue(lastAsked_)) {
    const nb::gil_scoped_acquire acquired;
    askSignals();
  }
  return stopped_;
}

}  // namespace prelight::python
