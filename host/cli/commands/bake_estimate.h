#pragma once

#include <cstdint>
#include <optional>

#include "cli/session.h"

namespace prelight::cli {

/// How long a bake would take, estimated from bakes of the same scene and options with few rays.
struct BakeEstimate {
  BakeRun sample;          ///< the last trial bake
  std::uint64_t rays = 0;  ///< rays per vertex in the last trial bake
  double spent = 0.0;      ///< s that all trial bakes took
  /// Time for everything but reading the scene, if nothing else keeps the machine busy; none: the number of
  /// rays depends on the error that they reach
  std::optional<double> seconds;
  /// Processor time of all threads; none: the number of rays is not known, or the device is no processor
  std::optional<double> processorSeconds;
};

BakeEstimate estimateBake(Session& session, const LoadedScene& loaded, const BakeRequest& request,
                          const DeviceOptions& deviceOptions);

}  // namespace prelight::cli
