#pragma once

#include <nanobind/nanobind.h>

#include <optional>

namespace prelight::python {

namespace nb = nanobind;

/// Work that a call does without the interpreter's lock, for as long as this object lives. The interpreter
/// waits for all such work before it ends (bindInterpreterEnd()): a thread that asks for the lock of an
/// interpreter that has ended dies in the middle of its work, and the process with it.
class UnlockedWork {
 public:
  /// Throws Interrupted if the interpreter is about to end.
  UnlockedWork();
  ~UnlockedWork();
  UnlockedWork(const UnlockedWork&) = delete;
  UnlockedWork& operator=(const UnlockedWork&) = delete;

  /// True from the moment when the interpreter is about to end; work that can be interrupted must then stop.
  static bool interpreterEnds();

 private:
  std::optional<nb::gil_scoped_release> released_;
};

/// Makes the interpreter, before it ends, ask all work of this module in other threads to stop, and wait
/// until they have returned.
void bindInterpreterEnd();

}  // namespace prelight::python
