#pragma once

#include <string_view>

#include "prelight/error.h"

namespace prelight {

/// A program of kernels that a device compiles because it has not run it before.
struct KernelCompilation {
  std::string_view program;  ///< its file, "bvh/wide_kernels.cl"
  double seconds = 0.0;      ///< spent on it so far
  bool finished = false;
};
class WorkKeeper;

/// How long work tells the outside where it is, and asks whether to go on. The default ignores both.
class Progress {
 public:
  virtual ~Progress() = default;

  /// `fraction` of `stage` is done, in [0,1].
  virtual void report(std::string_view /*stage*/, double /*fraction*/) {}

  /// Comes when a device begins to compile a program, ten times a second meanwhile, and when it has finished.
  virtual void compiling(const KernelCompilation& /*program*/) { report("compile kernels", 0.0); }

  /// Something that is odd and was dealt with, for people to read.
  virtual void warn(std::string_view /*warning*/) {}

  /// True once the user has asked to stop; polled between blocks of work.
  virtual bool stopRequested() const { return false; }

  /// What keeps the work's state, for those who do it (not a part of the library's interface); nullptr:
  /// nothing does.
  virtual WorkKeeper* keeper() const { return nullptr; }

  /// Throws Interrupted when the user has asked to stop.
  void check() const {
    if (stopRequested()) throw Interrupted();
  }
};

}  // namespace prelight
