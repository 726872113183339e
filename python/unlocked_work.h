#pragma once

#include <nanobind/nanobind.h>

#include <optional>

namespace prelight::python {

namespace nb = nanobind;

/// Work that a call does without the interpreter's lock, as long as it lives. An interpreter that ends waits
/// for all of it (bindInterpreterEnd()): a thread that asks for the lock of one that has ended dies within
/// whatever it was doing, and the process with it.
class UnlockedWork {
 public:
  /// Throws Interrupted where the interpreter is about to end.
  UnlockedWork();
  ~UnlockedWork();
  UnlockedWork(const UnlockedWork&) = delete;
  UnlockedWork& operator=(const UnlockedWork&) = delete;

  /// True from when the interpreter is about to end: work that can be interrupted is to stop.
  static bool interpreterEnds();

 private:
  std::optional<nb::gil_scoped_release> released_;
};

/// Has the interpreter, before it ends, ask all work that this module does in other threads to stop, and wait
/// until that has come back to it.
void bindInterpreterEnd();

}  // namespace prelight::python
