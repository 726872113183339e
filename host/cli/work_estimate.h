#pragma once

#include <functional>
#include <optional>
#include <string>

#include "prelight/device.h"

namespace prelight::cli {

/// What work took.
struct Work {
  double seconds = 0.0;    ///< that passed
  double processor = 0.0;  ///< s of all threads; what else the machine does hardly changes that
};

Work measureWork(const std::function<void()>& work);

/// What the program has taken so far, as far as it is told: `seconds` pass in steps that are timed.
Work workSoFar(double seconds);

/// The same work, done for a part of what it is to be done for: rays, passes or pixels.
struct WorkSample {
  double size = 0.0;
  Work work = {};
};

struct WorkEstimate {
  double seconds = 0.0;                         ///< where nothing else keeps the machine busy
  std::optional<double> processorSeconds = {};  ///< of all threads; none: the device is no processor
};

/// Of `size`, from two samples, of which `many` is the larger. Work grows by the same with every unit: by
/// processor time where the device is a processor, all of whose units what is added keeps busy; elsewhere by
/// the time that passes.
WorkEstimate extrapolate(const WorkSample& few, const WorkSample& many, double size,
                         const DeviceInfo& device);

/// Adds work that is done once, whatever the size: what came before, and what the first sample took longer
/// than another one of its kind.
void addOnce(const Work& before, const Work& first, const Work& again, WorkEstimate& estimate);

/// "about 12 s with the machine to itself, 23 s of processor time, on DEVICE".
std::string textOf(const WorkEstimate& estimate, const DeviceInfo& device);

}  // namespace prelight::cli
