#pragma once

#include <string>
#include <vector>

#include "device/opencl.h"
#include "prelight/device.h"

namespace prelight {

/// A device of OpenCL and what is told of it.
struct FoundDevice {
  cl::Device device;
  DeviceInfo info;
};

/// Every device of every platform; DeviceInfo::index is the place in the list. Platforms that fail are left
/// out.
std::vector<FoundDevice> findDevices();

/// Text that tells a device and its driver from all others: programs that were compiled for one fit no other.
std::string identityOf(const DeviceInfo& info);

/// Name of a device between the library and its compiler, which find the same list of devices.
std::string nameForCompiler(const DeviceInfo& info);

}  // namespace prelight
