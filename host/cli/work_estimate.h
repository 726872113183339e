#pragma once

#include <functional>
#include <optional>
#include <string>

#include "prelight/device.h"

namespace prelight::cli {

/// The time that some work took.
struct Work {
  double seconds = 0.0;    ///< time that passed
  double processor = 0.0;  ///< time of all threads, which hardly depends on what else the machine does
};

Work measureWork(const std::function<void()>& work);

/// Returns the time that the program has taken so far; `seconds` is the sum of its timed steps.
Work workSoFar(double seconds);

/// A part of some work, such as fewer rays, passes or pixels, and the time that it took.
struct WorkSample {
  double size = 0.0;
  Work work = {};
};

struct WorkEstimate {
  double seconds = 0.0;                         ///< if nothing else keeps the machine busy
  std::optional<double> processorSeconds = {};  ///< of all threads; none: the device is no processor
};

/// Estimates the work of size `size` from two samples, of which `many` is the larger. Every unit of size
/// takes the same time: processor time if the device is a processor, since additional work keeps all its
/// cores busy, else time that passes.
WorkEstimate extrapolate(const WorkSample& few, const WorkSample& many, double size,
                         const DeviceInfo& device);

/// Adds the work that is done once whatever the size: all work before, and the additional time of the first
/// sample over a second one of its kind.
void addOnce(const Work& before, const Work& first, const Work& again, WorkEstimate& estimate);

/// Returns a text such as "about 12 s with the machine to itself, 23 s of processor time, on DEVICE".
std::string textOf(const WorkEstimate& estimate, const DeviceInfo& device);

}  // namespace prelight::cli
