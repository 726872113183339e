#pragma once

#include <cstdint>
#include <vector>

#include "cast/cast_block.h"
#include "device/device_lane.h"
#include "device/kernel.h"
#include "gpu/tracer.h"

namespace prelight {

/// Values that projectSectors of kernels/project/sector_kernels.cl has of each sector.
constexpr std::size_t sectorRows = 3;

/// Which rays the sectors of azimuth around receivers' normals close and leave open; see
/// kernels/project/sector_kernels.cl.
class SectorCaster {
 public:
  /// Blocks of at most `blockSize` receivers, `lanes` of them at a time.
  SectorCaster(DeviceContext& device, std::uint32_t sectors, std::uint32_t blockSize, std::size_t lanes);

  /// Launches the sums of a block; finish() waits for them: [receiver][3][sector].
  void start(const CastBlockBuffers& block, std::uint32_t receivers, DeviceLane lane);
  void finish(std::uint32_t receivers, DeviceLane lane, std::vector<float>& values) const;

 private:
  std::uint32_t sectors_;
  std::vector<Buffer<float>> values_;  ///< [lane number]
  Kernel<Buffer<device::CastParameters>, std::uint32_t, Buffer<device::Receiver>, Buffer<device::Ray>,
         Buffer<device::Hit>, Buffer<float>>
      project_;
};

}  // namespace prelight
