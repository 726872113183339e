#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "prelight/progress.h"

namespace prelight {

enum class DeviceKind : std::uint8_t { Cpu, Gpu, Other };

/// An OpenCL device as `prelight devices` lists it.
struct DeviceInfo {
  int index = 0;  ///< index in listDevices(), accepted by DeviceOptions::selector
  DeviceKind kind = DeviceKind::Other;
  std::string name;
  std::string vendor;
  std::string platform;
  std::string platformVersion;
  std::string driverVersion;
  std::string openclVersion;  ///< such as "OpenCL 1.2 ..."
  std::uint32_t computeUnits = 0;
  std::uint64_t globalMemory = 0;   ///< bytes
  std::uint64_t maxAllocation = 0;  ///< bytes
  bool isPocl = false;
  bool hasDouble = false;
};

/// Options of Device::open().
struct DeviceOptions {
  /// Index, or part of "platform name"; none: the first GPU, else the first device.
  std::optional<std::string> selector = {};
  std::optional<bool> cacheKernels = {};   ///< none: as if true
  std::filesystem::path dumpKernels = {};  ///< folder for the expanded sources; empty: none are written
  bool portableKernels = false;  ///< uses plain OpenCL C even where the compiler offers faster instructions
  /// Receives warnings about the device and reports of kernel compilation, and is asked meanwhile whether to
  /// stop, from whichever thread needs the kernels. It must outlive the device. nullptr: no reports.
  Progress* progress = nullptr;
};

/// Returns every device of every platform; none when there is no OpenCL platform. Throws Error(OutOfMemory)
/// where the system cannot create the threads that a platform starts.
std::vector<DeviceInfo> listDevices();

class DeviceContext;

/// An opened device with its queue and program cache. Movable, not copyable.
class Device {
 public:
  /// Opens the selected device. Throws Error(NoDevice) when there is no platform, naming the package that
  /// provides one, or when no device matches the selector.
  static Device open(const DeviceOptions& options);

  explicit Device(std::unique_ptr<DeviceContext> context);
  Device(Device&&) noexcept;
  Device& operator=(Device&&) noexcept;
  ~Device();

  const DeviceInfo& info() const;
  DeviceContext& context() const { return *context_; }

 private:
  std::unique_ptr<DeviceContext> context_;
};

/// OpenCL's own objects of a device, for programs that run kernels of their own on its buffers: a cl_context,
/// a cl_device_id and the cl_command_queue in which the library's commands run in order. They live as long as
/// the device.
struct OpenClHandles {
  void* context = nullptr;
  void* device = nullptr;
  void* queue = nullptr;
};

OpenClHandles openclHandles(const Device& device);

}  // namespace prelight
