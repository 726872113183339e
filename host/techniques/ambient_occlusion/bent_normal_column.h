#pragma once

#include <vector>

#include "cast/hemisphere_column.h"
#include "prelight/progress.h"

namespace prelight {

/// Mean open directions of receivers, taken from the rows of the hemisphere. Only fronts have rows.
class BentNormalColumn final : public FittedColumn {
 public:
  /// Both must outlive the column.
  BentNormalColumn(const CompiledScene& scene, const HemisphereColumn& hemisphere)
      : FittedColumn(0, 3), scene_(scene), hemisphere_(hemisphere) {}

  /// Fitted unit mean open direction minus the slot's normal, [slot][3].
  std::vector<float> solve(const SideSums& side, const Progress& progress) const;

  ColumnNeeds needs() const override { return {.rays = false}; }
  bool castFrom(Side side) const override { return side == Side::Front; }
  void addTo(VertexFit& fit, const SeenBlock& block, std::vector<double>& rows) const override;

 private:
  const CompiledScene& scene_;
  const HemisphereColumn& hemisphere_;
};

}  // namespace prelight
