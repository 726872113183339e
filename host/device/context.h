#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "prelight/device.h"

namespace prelight {

/// Options of an OpenCL build, separated by spaces.
class BuildOptions {
 public:
  BuildOptions& define(std::string_view name) { return add(fmt::format("-D{}=1", name)); }
  BuildOptions& define(std::string_view name, int value) { return add(fmt::format("-D{}={}", name, value)); }
  BuildOptions& defineIf(bool condition, std::string_view name) { return condition ? define(name) : *this; }

  const std::string& text() const { return text_; }

 private:
  BuildOptions& add(const std::string& option) {
    if (!text_.empty()) text_ += ' ';
    text_ += option;
    return *this;
  }

  std::string text_ = "-cl-std=CL1.2";
};

/// One of a device's in-order command queues. Commands of a lane run in the order in which they were given;
/// commands of different lanes run concurrently and fill each other's idle times.
struct DeviceLane {
  static constexpr std::size_t count = 2;

  std::size_t number = 0;  ///< less than count
};

class OpenClContext;  // device/opencl_context.h

/// Counts of the work that a device was given since it was opened.
struct DeviceUse {
  std::uint64_t launches = 0;   ///< kernel launches, except those of 0 work-items
  std::uint64_t workItems = 0;  ///< work-items of all launches
  std::uint64_t bytes = 0;      ///< total size of all buffers made, including those since released
};

/// State that the buffers and kernels of a device share. Hides all OpenCL types.
class DeviceContext {
 public:
  explicit DeviceContext(std::unique_ptr<OpenClContext> opencl);
  ~DeviceContext();

  const DeviceInfo& info() const;

  /// Builds the program of an embedded kernel file ("bvh/wide_kernels.cl"), once per option set. Kernels also
  /// do this when they are made. Throws Error(RuntimeFailure) with device, options and build log when the
  /// build fails.
  void build(const std::string& file, const BuildOptions& options);

  /// Adds a kernel file besides the embedded ones, which it may include. A name must always have the same
  /// text.
  void addFile(const std::string& file, const std::string& text);

  /// Seconds spent building or loading programs so far.
  double buildSeconds() const;

  DeviceUse use() const;

  /// Waits for all launched commands.
  void finish();

  /// Returns the OpenCL objects, for use in host/device only.
  OpenClContext& opencl() const { return *opencl_; }

 private:
  std::unique_ptr<OpenClContext> opencl_;
};

}  // namespace prelight
