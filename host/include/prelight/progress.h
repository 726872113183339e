#pragma once

#include <string_view>

#include "prelight/error.h"

namespace prelight {

/// A kernel program that a device compiles because it is not in the cache.
struct KernelCompilation {
  std::string_view program;  ///< its file, such as "bvh/wide_kernels.cl"
  double seconds = 0.0;      ///< spent on it so far
  bool finished = false;
};
class WorkKeeper;

/// Receiver of progress reports, which also decides whether long work stops. The default ignores reports and
/// never stops.
class Progress {
 public:
  virtual ~Progress() = default;

  /// Reports that the fraction, in [0,1], of a stage is done.
  virtual void report(std::string_view /*stage*/, double /*fraction*/) {}

  /// Reports a compilation: when a device begins to compile a program, ten times per second meanwhile, and at
  /// the end.
  virtual void compiling(const KernelCompilation& /*program*/) { report("compile kernels", 0.0); }

  /// Reports an oddity that was handled, as a message for the user.
  virtual void warn(std::string_view /*warning*/) {}

  /// Returns whether the work shall stop. It is polled between blocks of work.
  virtual bool stopRequested() const { return false; }

  /// Returns what keeps the state of unfinished work, or nullptr if nothing does. It is internal to the
  /// library.
  virtual WorkKeeper* keeper() const { return nullptr; }

  /// Throws Interrupted when the user has asked to stop.
  void check() const {
    if (stopRequested()) throw Interrupted();
  }
};

}  // namespace prelight
