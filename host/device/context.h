#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "device/build_options.h"
#include "prelight/device.h"

namespace prelight {

class OpenClContext;  // device/opencl_context.h

/// What a device has been asked for since it was opened.
struct DeviceUse {
  std::uint64_t launches = 0;   ///< of kernels, without those of no work-item
  std::uint64_t workItems = 0;  ///< of all launches
  std::uint64_t bytes = 0;      ///< of all buffers that were made, also those that are gone
};

/// What buffers and kernels of a device share. Shows nothing of OpenCL.
class DeviceContext {
 public:
  explicit DeviceContext(std::unique_ptr<OpenClContext> opencl);
  ~DeviceContext();

  const DeviceInfo& info() const;

  /// Builds the program of an embedded kernel file ("bvh/wide_kernels.cl"), once per option set; kernels do
  /// so when they are made. Throws Error(RuntimeFailure) with device, options and build log when it does not
  /// build.
  void build(const std::string& file, const BuildOptions& options);

  /// A kernel file besides the embedded ones, which it may include; a name stands for one text.
  void addFile(const std::string& file, const std::string& text);

  /// Seconds spent building or loading programs so far.
  double buildSeconds() const;

  DeviceUse use() const;

  /// Waits for all that has been launched.
  void finish();

  /// OpenCL's side of it, for host/device alone.
  OpenClContext& opencl() const { return *opencl_; }

 private:
  std::unique_ptr<OpenClContext> opencl_;
};

}  // namespace prelight
