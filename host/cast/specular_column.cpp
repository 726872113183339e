#include "cast/specular_column.h"

namespace prelight {

namespace {

std::size_t widthOf(const SpecularWays& ways) {
  return 3 * static_cast<std::size_t>(ways.shOrder * ways.shOrder);
}

}  // namespace

SpecularColumn::SpecularColumn(const SpecularWays& ways)
    : FittedColumn(widthOf(ways), widthOf(ways)), ways_(ways) {}

void SpecularColumn::allocate(const CastShape& shape) {
  caster_.emplace(shape.scene, ways_, shape.tracer, std::size_t{shape.blockSize} * shape.raysPerReceiver,
                  shape.raysPerReceiver);
}

void SpecularColumn::finish(const CastBlock& block, ColumnRows& rows) {
  caster_->cast(block.buffers, block.receivers, block.tracer);
  if (hasValues())
    ColumnRows::read(caster_->project(block.buffers, block.receivers), 0, block.receivers * rowWidth(),
                     rows.rows);
}

std::unique_ptr<ColumnSums> SpecularColumn::makeSums(const SideShape& side) {
  return hasValues() ? FittedColumn::makeSums(side) : nullptr;
}

void SpecularColumn::save(StateWriter& state) const {
  state.value(rays());
  state.value(steps());
}

void SpecularColumn::load(StateReader& state) {
  state.value(earlierRays_);
  state.value(earlierSteps_);
  state.require(earlierSteps_ <= earlierRays_);
}

}  // namespace prelight
