#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "prelight/device.h"
#include "prelight/plan.h"
#include "prelight/transfer.h"

namespace prelight::cli {

/// The options by which a bake is asked for, shared by the commands that bake.
struct BakeOptions {
  BakeRequest request;
  std::optional<CompressionRequest> compression;  ///< of the SH transfer
  std::optional<bool> cacheKernels;
  std::filesystem::path dumpKernels;

  bool techniqueGiven() const { return request.anything(); }
  void addTo(DeviceOptions& device) const;
};

/// What a bake makes when no technique is named: AO and SH of order 3 with one bounce.
void useDefaultTechniques(BakeRequest& request);

/// "--ao --sh 3 --bounces 1": the techniques of a request as options.
std::string techniqueText(const BakeRequest& request);

/// --ao, --sh, --ch, --haar, --glossy, --light-groups, --bounces, and what shapes them.
void addTechniqueOptions(CLI::App& app, BakeOptions& options);

/// --rays, --error, --time, --seed and --max-memory.
void addEffortOptions(CLI::App& app, BakeOptions& options);

/// --cache-kernels and --dump-kernels.
void addKernelOptions(CLI::App& app, BakeOptions& options);

}  // namespace prelight::cli
