#pragma once

#include <cstddef>
#include <memory>

#include "device/context.h"
#include "device/device_lane.h"

namespace prelight {

/// Bytes on a device, which buffers share. Operations take their turn with the launches of a lane.
class DeviceMemory {
 public:
  struct OpenCl;  // device/opencl_memory.h

  /// `readOnly`: for kernels. Throws Error(OutOfMemory) naming the size when the device cannot hold it.
  DeviceMemory(DeviceContext& device, std::size_t bytes, bool readOnly, DeviceLane lane);
  ~DeviceMemory();
  DeviceMemory(const DeviceMemory&) = delete;
  DeviceMemory& operator=(const DeviceMemory&) = delete;

  /// Waits.
  void write(const void* data, std::size_t bytes, std::size_t at);
  void read(void* data, std::size_t bytes, std::size_t at) const;

  /// Memory of the host that stands for the first `bytes` until unmap(): what they are, or room for others.
  /// Where the device shares the host's memory nothing is copied. Waits.
  const void* mapToRead(std::size_t bytes) const;
  void* mapToOverwrite(std::size_t bytes);

  /// Does not wait.
  void unmap(const void* mapped) const noexcept;

  /// Repeats `pattern` over the first `bytes`; its size is a power of two up to 128. Does not wait.
  void fill(const void* pattern, std::size_t patternBytes, std::size_t bytes);

  /// The first `bytes` of another. Does not wait.
  void copy(const DeviceMemory& from, std::size_t bytes);

  /// OpenCL's side of it, for host/device alone.
  const OpenCl& opencl() const { return *opencl_; }

 private:
  std::unique_ptr<OpenCl> opencl_;
};

}  // namespace prelight
