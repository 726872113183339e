#pragma once

#include <optional>

#include "cast/fitted_column.h"
#include "cast/specular_caster.h"

namespace prelight {

/// Transfer of the light that comes from the sky by way of mirrors, glass, rough lobes and the inside of
/// bodies, in SH: rows of [3][i]. Rows of senders that stay on the device have the ends of these ways.
class SpecularColumn final : public FittedColumn {
 public:
  explicit SpecularColumn(const SpecularWays& ways);

  /// Returns whether there are rows; else rays are followed for their ends alone.
  bool hasValues() const { return rowWidth() > 0; }

  /// Returns where the rays of the block that was finished last ended, [ray].
  const Buffer<device::SpecularEnd>& ends() const { return caster_.value().ends(); }

  ColumnNeeds needs() const override {
    return {.closestHits = true, .ownRays = true, .blockedRays = hasValues()};
  }
  void finish(const CastBlock& block, ColumnRows& rows) override;
  std::unique_ptr<ColumnSums> makeSums(const SideShape& side) override;
  std::uint64_t rays() const override { return earlierRays_ + (caster_ ? caster_->rays() : 0); }
  void save(StateWriter& state) const override;
  void load(StateReader& state) override;

  /// Returns how many of the rays were steps within bodies.
  std::uint64_t steps() const { return earlierSteps_ + (caster_ ? caster_->steps() : 0); }

 private:
  void allocate(const CastShape& shape) override;

  SpecularWays ways_;
  std::optional<SpecularCaster> caster_;
  std::uint64_t earlierRays_ = 0, earlierSteps_ = 0;  ///< of runs that load() goes on with
};

}  // namespace prelight
