#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "prelight/device.h"
#include "prelight/plan.h"
#include "prelight/refine.h"
#include "prelight/save_compressed.h"
#include "prelight/techniques.h"

namespace prelight::pictures {

/// What bakes are asked for with: their request, and what is done with kernels and with the result.
struct BakeSettings {
  BakeRequest request;
  RefineRequest refine;               ///< of the scene, before it is baked
  FileCompression compression;        ///< of what is baked
  std::optional<bool> cacheKernels;   ///< none: as DeviceOptions
  std::filesystem::path dumpKernels;  ///< folder; empty: kernels are not written

  bool techniqueGiven() const { return request.anything(); }
  void addTo(DeviceOptions& device) const;
};

/// Adds what a bake makes when no technique is named: AO and SH of order 3 with one bounce.
void useDefaultTechniques(BakeRequest& request);

/// The techniques of a request for messages, in which front ends replace members by their options: as the
/// program prints it, "--ao --sh 3 --bounces 1".
std::string techniqueText(const BakeRequest& request);

}  // namespace prelight::pictures
