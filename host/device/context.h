#pragma once

#include <memory>
#include <string>

#include "device/build_options.h"
#include "prelight/device.h"

namespace prelight {

class OpenClContext;  // device/opencl_context.h

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

  /// Waits for all that has been launched.
  void finish();

  /// OpenCL's side of it, for host/device alone.
  OpenClContext& opencl() const { return *opencl_; }

 private:
  std::unique_ptr<OpenClContext> opencl_;
};

}  // namespace prelight
