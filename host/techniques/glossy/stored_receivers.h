#pragma once

#include <vector>

#include "cast/column.h"

namespace prelight {

class SideSums;

/// Receivers whose rows stay on the device, so that their rays can be drawn once more. Only fronts are kept.
class StoredReceivers final : public Column {
 public:
  /// Returns the receivers of a side, parallel to its first records.
  const std::vector<device::Receiver>& receiversOn(const SideSums& side) const;

  bool castFrom(Side side) const override { return side == Side::Front; }
  bool takes(const CastTask& task) const override { return task.firstRow.has_value(); }
  std::unique_ptr<ColumnSums> makeSums(const SideShape& side) override;
};

}  // namespace prelight
