#pragma once

#include <string_view>

#include "prelight/error.h"

namespace prelight {

/// How long work tells the outside where it is, and asks whether to go on. The default ignores both.
class Progress {
 public:
  virtual ~Progress() = default;

  /// `fraction` of `stage` is done, in [0,1].
  virtual void report(std::string_view /*stage*/, double /*fraction*/) {}

  /// True once the user has asked to stop; polled between blocks of work.
  virtual bool stopRequested() const { return false; }

  /// Throws Interrupted when the user has asked to stop.
  void check() const {
    if (stopRequested()) throw Interrupted();
  }
};

}  // namespace prelight
