#pragma once

#include <string>
#include <vector>

#include "device/opencl.h"
#include "prelight/device.h"

namespace prelight {

/// An OpenCL device with its description.
struct FoundDevice {
  cl::Device device;
  DeviceInfo info;
};

/// Returns every device of every platform, in the order of DeviceInfo::index. Platforms that fail are
/// skipped.
std::vector<FoundDevice> findDevices();

/// Returns a text that identifies a device and its driver, since compiled programs fit no other.
std::string identityOf(const DeviceInfo& info);

/// Returns the name by which the library tells its compiler, which finds the same list of devices, which one
/// to use.
std::string nameForCompiler(const DeviceInfo& info);

}  // namespace prelight
