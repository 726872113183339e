#pragma once

#include <cstdint>
#include <optional>

#include "cli/session.h"

namespace prelight::cli {

/// How long a bake would take, from bakes of the same scene and options by a few rays.
struct BakeEstimate {
  BakeRun sample;                 ///< the last of them
  std::uint64_t rays = 0;         ///< a vertex, of the last of them
  double spent = 0.0;             ///< s, by all of them
  std::optional<double> seconds;  ///< of all but reading the scene, where nothing else keeps the machine
                                  ///< busy; none: the error decides how many rays there are
  std::optional<double> processorSeconds;  ///< of all threads; none: as above, or the device is no processor
};

BakeEstimate estimateBake(Session& session, const LoadedScene& loaded, const BakeRequest& request,
                          const DeviceOptions& deviceOptions);

}  // namespace prelight::cli
