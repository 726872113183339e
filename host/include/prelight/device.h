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
  int index = 0;  ///< position in listDevices(), which DeviceOptions::selector takes
  DeviceKind kind = DeviceKind::Other;
  std::string name;
  std::string vendor;
  std::string platform;
  std::string platformVersion;
  std::string driverVersion;
  std::string openclVersion;  ///< "OpenCL 1.2 ..."
  std::uint32_t computeUnits = 0;
  std::uint64_t globalMemory = 0;   ///< bytes
  std::uint64_t maxAllocation = 0;  ///< bytes
  bool isPocl = false;
  bool hasDouble = false;
};

struct DeviceOptions {
  std::optional<std::string> selector =
      {};  ///< index or part of "platform name"; none: first GPU, else first device
  std::optional<bool> cacheKernels = {};   ///< none: on
  std::filesystem::path dumpKernels = {};  ///< folder for the expanded sources; empty: none
  bool portableKernels = false;  ///< nothing but OpenCL C, even where the compiler offers faster instructions
  /// Told what is odd about the device and which kernels it compiles, and asked meanwhile whether to go on;
  /// by whatever thread needs them. Outlives the device. nullptr: nobody.
  Progress* progress = nullptr;
};

/// Every device of every platform; empty when there is no OpenCL platform. Throws Error(OutOfMemory) where
/// the system lacks the threads that a platform starts.
std::vector<DeviceInfo> listDevices();

class DeviceContext;

/// An opened device with its queue and program cache. Movable, not copyable.
class Device {
 public:
  /// Throws Error(NoDevice): no platform (says which package gives one) or none that matches the selector.
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

}  // namespace prelight
