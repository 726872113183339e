#include "techniques/horizons/sector_column.h"

#include "cast/side_sums.h"

namespace prelight {

void SectorColumn::allocate(const CastShape& shape) {
  FittedColumn::allocate(shape);
  project_ = {shape.tracer.context(), "techniques/horizons/sector_kernels.cl", {}, "projectSectors"};
}

void SectorColumn::start(const CastBlock& block) {
  project_.launch({block.receivers, block.lane}, block.buffers.parameters, sectors_, block.buffers.receivers,
                  block.buffers.rays, block.buffers.hits, valuesOf(block));
}

// The open part is fitted less 1: rows of receivers that see nothing are then all 0, which is exact.
void SectorColumn::addTo(VertexFit& fit, const SeenBlock& block, std::vector<double>& rows) const {
  const auto values = block.rows.of(*this).of<float>();
  rows.assign(values.begin(), values.end());
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (i / sectors_ % sectorRows == 1) rows[i] -= 1.0;
  fit.add(block.samples, rows);
}

std::vector<float> SectorColumn::solve(const SideSums& side, const Progress& progress) const {
  return fitOn(side).solve(side.fit().equations(defaultSmoothing), {.progress = &progress});
}

}  // namespace prelight
