#include "cast/sector_caster.h"

namespace prelight {

SectorCaster::SectorCaster(DeviceContext& device, std::uint32_t sectors, std::uint32_t blockSize,
                           std::size_t lanes)
    : sectors_(sectors), project_(device, "project/sector_kernels.cl", {}, "projectSectors") {
  for (std::size_t lane = 0; lane < lanes; ++lane)
    values_.emplace_back(device, sectorRows * blockSize * sectors, DeviceLane{lane});
}

void SectorCaster::start(const CastBlockBuffers& block, std::uint32_t receivers, DeviceLane lane) {
  project_.launch({receivers, lane}, block.parameters, sectors_, block.receivers, block.rays, block.hits,
                  values_[lane.number]);
}

void SectorCaster::finish(std::uint32_t receivers, DeviceLane lane, std::vector<float>& values) const {
  values.resize(sectorRows * receivers * sectors_);
  values_[lane.number].read(std::span(values));
}

}  // namespace prelight
