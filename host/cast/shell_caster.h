#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cast/cast_block.h"
#include "device/device_lane.h"
#include "device/kernel.h"
#include "gpu/tracer.h"

namespace prelight {

/// Shells of distance that hits are told apart by.
struct ShellShape {
  int order = 0;              ///< bands of SH; 0: hits are not told apart
  std::vector<float> starts;  ///< m, ascending, of all shells but the first, which begins at the receiver

  std::size_t count() const { return order > 0 ? starts.size() + 1 : 0; }

  /// Floats a receiver: of a shell its blocked fraction and order^2 of SH.
  std::size_t valueCount() const { return count() * static_cast<std::size_t>(1 + order * order); }
};

/// What blocks light from receivers shell by shell, of hits that are the closest ones; see
/// kernels/project/shell_kernels.cl.
class ShellCaster {
 public:
  /// Blocks of at most `blockSize` receivers, `lanes` of them at a time.
  ShellCaster(DeviceContext& device, ShellShape shape, std::uint32_t blockSize, std::size_t lanes);

  /// Launches the sums of a block; finish() waits for them: [receiver][shell][1 + order^2].
  void start(const CastBlockBuffers& block, std::uint32_t receivers, DeviceLane lane);
  void finish(std::uint32_t receivers, DeviceLane lane, std::vector<float>& values) const;

 private:
  ShellShape shape_;
  Buffer<float> starts_;
  Buffer<float> shTable_;
  std::vector<Buffer<float>> values_;  ///< [lane number]
  Kernel<Buffer<device::CastParameters>, std::uint32_t, Buffer<float>, Buffer<float>, Buffer<device::Ray>,
         Buffer<device::Hit>, Buffer<float>>
      project_;
};

}  // namespace prelight
