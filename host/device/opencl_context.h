#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "device/build_options.h"
#include "device/context.h"
#include "device/device_lane.h"
#include "device/opencl.h"
#include "device/program_cache.h"
#include "prelight/device.h"

namespace prelight {

/// What a DeviceContext hides: context, in-order queues, programs. Headers that show cl:: types are for
/// host/device alone.
class OpenClContext {
 public:
  OpenClContext(const cl::Device& device, DeviceInfo info, const DeviceOptions& options);

  const DeviceInfo& info() const { return info_; }
  const cl::CommandQueue& queue(DeviceLane lane) const { return queues_[lane.number]; }

  /// The program of an embedded kernel file ("bvh/wide_kernels.cl"), built once per option set.
  /// Throws Error(RuntimeFailure) with device, options and build log when it does not build.
  const cl::Program& program(const std::string& file, const BuildOptions& options);

  /// Does what DeviceContext::addFile() says.
  void addFile(const std::string& file, const std::string& text) { ownFiles_[file] = text; }

  /// Seconds spent building or loading programs so far.
  double buildSeconds() const { return buildSeconds_; }

  DeviceUse use() const { return {launches_, workItems_, bytes_}; }

  /// Throws Error(OutOfMemory) naming the size when the device cannot hold it.
  cl::Buffer allocate(std::size_t bytes, cl_mem_flags flags);

  /// Runs `kernel` over `items` work-items, rounded up to groups of `groupSize`; kernels check their bound.
  void launch(const cl::Kernel& kernel, std::size_t items, std::size_t groupSize, DeviceLane lane);

  /// Of all lanes.
  void finish() {
    for (cl::CommandQueue& queue : queues_) queue.finish();
  }

 private:
  std::string expand(const std::string& file) const;
  cl::Program build(const std::string& file, const std::string& source, const std::string& options);

  cl::Device device_;
  DeviceInfo info_;
  cl::Context context_;
  std::array<cl::CommandQueue, DeviceLane::count> queues_;
  ProgramCache cache_;
  std::filesystem::path dumpFolder_;
  bool portableKernels_;
  std::map<std::pair<std::string, std::string>, cl::Program> programs_;
  std::map<std::string, std::string> ownFiles_;
  double buildSeconds_ = 0.0;
  /// Stages that overlap launch at the same time.
  std::atomic<std::uint64_t> launches_ = 0, workItems_ = 0, bytes_ = 0;
};

}  // namespace prelight
