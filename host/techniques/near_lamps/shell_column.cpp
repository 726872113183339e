#include "techniques/near_lamps/shell_column.h"

#include "basis/sh_evaluate.h"
#include "basis/sh_zonal.h"

namespace prelight {

void ShellColumn::allocate(const CastShape& shape) {
  FittedColumn::allocate(shape);
  DeviceContext& device = shape.tracer.context();
  starts_ = Buffer<float>(device, std::span<const float>(shape_.starts));
  shTable_ = Buffer<float>(device, std::span<const float>(makeShTable(shape_.order)));
  project_ = {device, "techniques/near_lamps/shell_kernels.cl",
              BuildOptions().define("PRELIGHT_SH_ORDER", shape_.order), "projectShells"};
}

void ShellColumn::start(const CastBlock& block) {
  const auto shells = static_cast<std::uint32_t>(shape_.count());
  project_.launch({std::size_t{block.receivers} * shells, block.lane}, block.buffers.parameters, shells,
                  starts_, shTable_, block.buffers.rays, block.buffers.hits, valuesOf(block));
}

// As with what is open (HemisphereColumn): the closed form times a shell's share of the hemisphere is added.
void ShellColumn::addTo(VertexFit& fit, const SeenBlock& block, std::vector<double>& rows) const {
  const std::size_t bands = shape_.bands(), shells = shape_.count(), count = block.samples.size() * shells;
  const auto seen = block.rows.of(*this).of<float>();
  std::vector<double> open(bands);
  rows.resize(count * bands);
  for (std::size_t row = 0; row < count; ++row) {
    if (row % shells == 0) {
      const float* normal = block.receivers[row / shells].normal;
      sh::openTransfer({normal[0], normal[1], normal[2]}, shape_.order, open);
    }
    const float* values = &seen[row * (1 + bands)];
    for (std::size_t i = 0; i < bands; ++i)
      rows[row * bands + i] = double(values[1 + i]) + double(values[0]) * open[i];
  }
  fit.add(block.samples, rows);
}

std::vector<float> ShellColumn::solve(const SideSums& side, const Progress& progress) const {
  return fitOn(side).solve(defaultSmoothing, {.progress = &progress});
}

}  // namespace prelight
