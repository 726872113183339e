#pragma once

#include <optional>

#include "cast/fitted_column.h"
#include "cast/light_caster.h"
#include "cast/light_groups.h"

namespace prelight {

/// Direct light of groups of lights: rows of [3][group], irradiance over pi per unit of the group's colour;
/// or [3][group][value], incident radiance in SH as well (basis/incident_values.h).
class LightColumn final : public FittedColumn {
 public:
  /// The lights outlive it. `incidentOrder`: bands of incident radiance; 0: irradiance alone.
  explicit LightColumn(const GroupedLights& lights, int incidentOrder = 0);

  std::uint32_t groups() const;

  ColumnNeeds needs() const override;
  std::uint32_t receiversAtOnce(DeviceKind kind, std::uint32_t usual) const override;
  void finish(const CastBlock& block, ColumnRows& rows) override;

 private:
  void allocate(const CastShape& shape) override;

  const GroupedLights& lights_;
  int incidentOrder_;
  std::optional<LightCaster> caster_;
};

}  // namespace prelight
