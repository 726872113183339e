#include "python/progress.h"

namespace prelight::python {

namespace {

constexpr auto pause = std::chrono::milliseconds(50);

}  // namespace

void warnInPython(std::string_view warning) {
  const nb::gil_scoped_acquire acquired;
  if (PyErr_WarnEx(PyExc_RuntimeWarning, std::string(warning).c_str(), 1) != 0) nb::raise_python_error();
}

bool PythonProgress::isDue() const {
  if (UnlockedWork::interpreterEnds()) stopped_ = true;
  const Clock::time_point now = Clock::now();
  if (stopped_ || now - last_ < pause) return false;
  last_ = now;
  return true;
}

void PythonProgress::tell() const {
  const nb::gil_scoped_acquire acquired;
  try {
    if (PyErr_CheckSignals() != 0) nb::raise_python_error();
    if (told_.is_none()) return;
    const nb::object answer = told_(nb::str(stage_.c_str()), fraction_);
    if (answer.ptr() == Py_False) stopped_ = true;
  } catch (...) {
    raised_ = std::current_exception();
    stopped_ = true;
  }
}

void PythonProgress::report(std::string_view stage, double fraction) {
  if (std::this_thread::get_id() != caller_) return;
  stage_ = stage;
  fraction_ = fraction;
  if (isDue()) tell();
}

void PythonProgress::warn(std::string_view warning) {
  try {
    warnInPython(warning);
  } catch (...) {
    raised_ = std::current_exception();
    stopped_ = true;
  }
}

bool PythonProgress::stopRequested() const {
  if (std::this_thread::get_id() == caller_ && isDue()) tell();
  return stopped_;
}

}  // namespace prelight::python
