#pragma once

#include <cstddef>
#include <memory>

#include "device/context.h"

namespace prelight {

/// Device memory that copies of a buffer share. Operations are queued on a lane together with its launches.
class DeviceMemory {
 public:
  struct OpenCl;  // device/opencl_context.h

  /// `readOnly` applies to kernels. Throws Error(OutOfMemory) naming the size when the device cannot allocate
  /// it.
  DeviceMemory(DeviceContext& device, std::size_t bytes, bool readOnly, DeviceLane lane);
  ~DeviceMemory();
  DeviceMemory(const DeviceMemory&) = delete;
  DeviceMemory& operator=(const DeviceMemory&) = delete;

  /// Copy bytes to or from offset `at` and wait.
  void write(const void* data, std::size_t bytes, std::size_t at);
  void read(void* data, std::size_t bytes, std::size_t at) const;

  /// Maps the first `bytes` into host memory until unmap(), to read or to overwrite them, and waits. Devices
  /// that share the host's memory need no copy.
  const void* mapToRead(std::size_t bytes) const;
  void* mapToOverwrite(std::size_t bytes);

  /// Ends a mapping. Does not wait.
  void unmap(const void* mapped) const noexcept;

  /// Repeats `pattern` over the first `bytes`; its size is a power of two up to 128. Does not wait.
  void fill(const void* pattern, std::size_t patternBytes, std::size_t bytes);

  /// Copies the first `bytes` of another memory. Does not wait.
  void copy(const DeviceMemory& from, std::size_t bytes);

  /// Returns OpenCL's cl_mem, for programs with kernels of their own.
  void* handle() const;

  /// Returns the OpenCL objects, for use in host/device only.
  const OpenCl& opencl() const { return *opencl_; }

 private:
  std::unique_ptr<OpenCl> opencl_;
};

}  // namespace prelight
