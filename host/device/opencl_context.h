#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <string>

#include "device/context.h"
#include "device/device_memory.h"
#include "device/opencl.h"
#include "device/opencl_program_builder.h"
#include "prelight/device.h"

namespace prelight {

/// The OpenCL objects behind a DeviceContext: context, in-order queues and programs. Headers with cl:: types
/// may only be included in host/device.
class OpenClContext {
 public:
  OpenClContext(const cl::Device& device, DeviceInfo info, const DeviceOptions& options);

  const DeviceInfo& info() const { return info_; }
  const cl::CommandQueue& queue(DeviceLane lane) const { return queues_[lane.number]; }

  /// Returns the program of an embedded kernel file ("bvh/wide_kernels.cl"), built once per option set.
  /// Throws Error(RuntimeFailure) with device, options and build log when the build fails.
  const cl::Program& program(const std::string& file, const BuildOptions& options) {
    return builder_.program(file, options);
  }

  /// Implements DeviceContext::addFile().
  void addFile(const std::string& file, const std::string& text) { builder_.addFile(file, text); }

  /// Seconds spent building or loading programs so far.
  double buildSeconds() const { return builder_.seconds(); }

  DeviceUse use() const { return {launches_, workItems_, bytes_}; }

  /// Allocates a buffer. Throws Error(OutOfMemory) naming the size when the device cannot.
  cl::Buffer allocate(std::size_t bytes, cl_mem_flags flags);

  /// Runs `kernel` over `items` work-items, rounded up to groups of `groupSize`; kernels check their bound.
  void launch(const cl::Kernel& kernel, std::size_t items, std::size_t groupSize, DeviceLane lane);

  /// Waits for all lanes.
  void finish() {
    calling([&] {
      for (cl::CommandQueue& queue : queues_) queue.finish();
    });
  }

 private:
  cl::Device device_;
  DeviceInfo info_;
  cl::Context context_;
  std::array<cl::CommandQueue, DeviceLane::count> queues_;
  ProgramBuilder builder_;
  /// Atomic because overlapping stages launch concurrently.
  std::atomic<std::uint64_t> launches_ = 0, workItems_ = 0, bytes_ = 0;
};

struct DeviceMemory::OpenCl {
  cl::CommandQueue queue;
  cl::Buffer buffer;
};

}  // namespace prelight
