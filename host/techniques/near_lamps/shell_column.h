#pragma once

#include <cstdint>
#include <vector>

#include "cast/fitted_column.h"
#include "device/kernel.h"
#include "prelight/progress.h"

namespace prelight {

/// Shells of distance that hits are told apart by.
struct ShellShape {
  int order = 0;              ///< bands of SH, at least 1
  std::vector<float> starts;  ///< m, ascending, of all shells but the first, which begins at the receiver

  std::size_t count() const { return starts.size() + 1; }
  std::size_t bands() const { return static_cast<std::size_t>(order * order); }
};

/// Blocked light, told apart by the shell of distance in which a ray ends: rows of [shell][order^2]; see
/// host/techniques/near_lamps/shell_kernels.cl. Only fronts have rows.
class ShellColumn final : public FittedColumn {
 public:
  explicit ShellColumn(ShellShape shape)
      : FittedColumn(shape.count() * shape.bands(), shape.count() * shape.bands()),
        shape_(std::move(shape)) {}

  /// Fitted shells, [slot][shell][i].
  std::vector<float> solve(const SideSums& side, const Progress& progress) const;

  ColumnNeeds needs() const override { return {.closestHits = true, .blockedRays = true}; }
  bool castFrom(Side side) const override { return side == Side::Front; }
  void start(const CastBlock& block) override;

 private:
  void allocate(const CastShape& shape) override;

  ShellShape shape_;
  Buffer<float> starts_;
  Buffer<float> zonal_;
  Buffer<float> shTable_;
  Kernel<Buffer<device::CastParameters>, Buffer<float>, Buffer<float>, Buffer<float>,
         Buffer<device::Receiver>, Buffer<device::Ray>, Buffer<device::Hit>, Buffer<float>>
      project_;
};

}  // namespace prelight
