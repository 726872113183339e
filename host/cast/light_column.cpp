#include "cast/light_column.h"

namespace prelight {

LightColumn::LightColumn(const GroupedLights& lights, int incidentOrder)
    : FittedColumn(3 * lights.groups.size() * lightValuesOfGroup(incidentOrder),
                   3 * lights.groups.size() * lightValuesOfGroup(incidentOrder)),
      lights_(lights),
      incidentOrder_(incidentOrder) {}

std::uint32_t LightColumn::groups() const { return static_cast<std::uint32_t>(lights_.groups.size()); }

ColumnNeeds LightColumn::needs() const { return {.closestHits = !lights_.emitters.empty(), .ownRays = true}; }

std::uint32_t LightColumn::receiversAtOnce(DeviceKind kind, std::uint32_t usual) const {
  return receiversPerLightBlock(kind, lights_, incidentOrder_, usual);
}

void LightColumn::allocate(const CastShape& shape) {
  caster_.emplace(shape.scene, lights_, shape.sets, shape.tracer, shape.blockSize, incidentOrder_);
}

void LightColumn::finish(const CastBlock& block, ColumnRows& rows) {
  ColumnRows::read(caster_->cast(block.buffers, block.receivers, block.tracer, block.task.set), 0,
                   block.receivers * rowWidth(), rows.rows);
}

}  // namespace prelight
