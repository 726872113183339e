#include "techniques/near_lamps/shell_column.h"

#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"

namespace prelight {

void ShellColumn::allocate(const CastShape& shape) {
  FittedColumn::allocate(shape);
  DeviceContext& device = shape.tracer.context();
  starts_ = Buffer<float>(device, std::span<const float>(shape_.starts));
  std::vector<float> zonal;
  for (int band = 0; band < shape_.order; ++band)
    zonal.push_back(static_cast<float>(sh::clampedCosine(band)));
  zonal_ = Buffer<float>(device, std::span<const float>(zonal));
  shTable_ = Buffer<float>(device, std::span<const float>(makeShTable(shape_.order)));
  project_ = {device, "techniques/near_lamps/shell_kernels.cl",
              BuildOptions()
                  .define("PRELIGHT_SH_ORDER", shape_.order)
                  .define("PRELIGHT_RAYS", static_cast<int>(shape.raysPerReceiver))
                  .define("PRELIGHT_SHELLS", static_cast<int>(shape_.count())),
              "projectShells"};
}

void ShellColumn::start(const CastBlock& block) {
  project_.launch({block.receivers, block.lane}, block.buffers.parameters, starts_, zonal_, shTable_,
                  block.buffers.receivers, block.buffers.rays, block.buffers.hits, valuesOf(block));
}

std::vector<float> ShellColumn::solve(const SideSums& side, const Progress& progress) const {
  SolveLimits limits = noisyValues();
  limits.progress = &progress;
  return fitOn(side).solve(defaultSmoothing, limits);
}

}  // namespace prelight
