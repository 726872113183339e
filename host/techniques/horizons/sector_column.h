#pragma once

#include <cstdint>
#include <vector>

#include "cast/fitted_column.h"
#include "device/kernel.h"
#include "prelight/progress.h"

namespace prelight {

/// Values per sector that projectSectors of host/techniques/horizons/sector_kernels.cl writes.
constexpr std::size_t sectorRows = 3;

/// Which rays the sectors of azimuth around receivers' normals close and leave open: rows of [3][sector]; see
/// host/techniques/horizons/sector_kernels.cl. Only fronts have rows.
class SectorColumn final : public FittedColumn {
 public:
  explicit SectorColumn(std::uint32_t sectors)
      : FittedColumn(sectorRows * sectors, sectorRows * sectors), sectors_(sectors) {}

  /// Fitted values, [slot][3][sector], of which what escapes is less 1: by the equations of accessibility,
  /// which is the mean of that.
  std::vector<float> solve(const SideSums& side, const Progress& progress) const;

  bool castFrom(Side side) const override { return side == Side::Front; }
  void start(const CastBlock& block) override;
  void addTo(VertexFit& fit, const SeenBlock& block, std::vector<double>& rows) const override;

 private:
  void allocate(const CastShape& shape) override;

  std::uint32_t sectors_;
  Kernel<Buffer<device::CastParameters>, std::uint32_t, Buffer<device::Receiver>, Buffer<device::Ray>,
         Buffer<device::Hit>, Buffer<float>>
      project_;
};

}  // namespace prelight
