#include "cast/fitted_column.h"

#include "cast/side_sums.h"

namespace prelight {

VertexFit emptyFit(const SideShape& side, std::size_t columns) {
  return side.areas != nullptr ? VertexFit(side.mesh, columns, *side.areas) : VertexFit(side.mesh, columns);
}

const VertexFit& FittedColumn::fitOn(const SideSums& side) const {
  return static_cast<const FittedSums&>(side.of(*this)).fit();
}

void FittedColumn::allocate(const CastShape& shape) {
  if (rowWidth_ > 0) values_ = DeviceRows<float>(shape, rowWidth_);
}

void FittedColumn::finish(const CastBlock& block, ColumnRows& rows) {
  if (rowWidth_ > 0) values_.read(block, rows);
}

void FittedColumn::loadBlock(StateReader& state, const CastTask& /*task*/, std::uint32_t receivers,
                             const ColumnRows& rows) {
  state.require(rows.records.empty() && rows.rows.size() == receivers * rowWidth_ * sizeof(float));
  state.requireFinite(rows.of<float>());
}

std::unique_ptr<ColumnSums> FittedColumn::makeSums(const SideShape& side) {
  return std::make_unique<FittedSums>(*this, emptyFit(side, fitWidth_));
}

void FittedColumn::addTo(VertexFit& fit, const SeenBlock& block, std::vector<double>& /*rows*/) const {
  fit.add(block.samples, block.rows.of(*this).of<float>());
}

}  // namespace prelight
