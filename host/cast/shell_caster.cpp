#include "cast/shell_caster.h"

#include <utility>

#include "basis/sh_table.h"

namespace prelight {

ShellCaster::ShellCaster(DeviceContext& device, ShellShape shape, std::uint32_t blockSize, std::size_t lanes)
    : shape_(std::move(shape)),
      starts_(device, std::span<const float>(shape_.starts)),
      shTable_(device, std::span<const float>(makeShTable(shape_.order))),
      project_(device, "project/shell_kernels.cl", BuildOptions().define("PRELIGHT_SH_ORDER", shape_.order),
               "projectShells") {
  for (std::size_t lane = 0; lane < lanes; ++lane)
    values_.emplace_back(device, blockSize * shape_.valueCount(), DeviceLane{lane});
}

void ShellCaster::start(const CastBlockBuffers& block, std::uint32_t receivers, DeviceLane lane) {
  const auto shells = static_cast<std::uint32_t>(shape_.count());
  project_.launch({std::size_t{receivers} * shells, lane}, block.parameters, shells, starts_, shTable_,
                  block.rays, block.hits, values_[lane.number]);
}

void ShellCaster::finish(std::uint32_t receivers, DeviceLane lane, std::vector<float>& values) const {
  values.resize(receivers * shape_.valueCount());
  values_[lane.number].read(std::span(values));
}

}  // namespace prelight
