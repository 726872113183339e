#include "device/opencl_devices.h"

#include <mutex>

namespace prelight {

namespace {

/// Removes spaces and NULs from the end; some OpenCL strings contain a NUL of their own.
std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
  return text;
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device, int index) {
  DeviceInfo info;
  info.index = index;
  const auto type = device.getInfo<CL_DEVICE_TYPE>();
  info.kind = (type & CL_DEVICE_TYPE_GPU)   ? DeviceKind::Gpu
              : (type & CL_DEVICE_TYPE_CPU) ? DeviceKind::Cpu
                                            : DeviceKind::Other;
  info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  info.vendor = trimmed(device.getInfo<CL_DEVICE_VENDOR>());
  info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
  info.platformVersion = trimmed(platform.getInfo<CL_PLATFORM_VERSION>());
  info.driverVersion = trimmed(device.getInfo<CL_DRIVER_VERSION>());
  info.openclVersion = trimmed(device.getInfo<CL_DEVICE_VERSION>());
  info.computeUnits = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  info.globalMemory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.maxAllocation = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  info.isPocl = info.platform == "Portable Computing Language";
  info.hasDouble = device.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_khr_fp64") != std::string::npos;
  return info;
}

}  // namespace

std::vector<FoundDevice> findDevices() {
  // Loaders and platforms initialise themselves at the first query, and not all support concurrent ones.
  static std::mutex asking;
  const std::lock_guard lock(asking);
  std::vector<FoundDevice> found;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {
    return found;  // the loader reports "no platform" as an error
  }
  for (const auto& platform : platforms) {
    std::vector<cl::Device> devices;
    try {
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error&) {
      continue;  // a platform without devices
    }
    for (const auto& device : devices) {
      const int index = static_cast<int>(found.size());
      found.push_back({device, describe(platform, device, index)});
    }
  }
  return found;
}

std::string identityOf(const DeviceInfo& info) {
  return info.name + '\n' + info.vendor + '\n' + info.driverVersion + '\n' + info.platformVersion;
}

std::string nameForCompiler(const DeviceInfo& info) {
  return std::to_string(info.index) + '\n' + identityOf(info);
}

}  // namespace prelight
