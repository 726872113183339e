#include "prelight/device.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <mutex>

#include "device/context.h"
#include "device/opencl_context.h"
#include "device/opencl_errors.h"
#include "prelight/error.h"

namespace prelight {

namespace {

struct FoundDevice {
  cl::Device device;
  DeviceInfo info;
};

/// OpenCL strings may end in a NUL of their own.
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

/// Loaders and platforms set themselves up at the first question; not all stand two of them at a time.
std::vector<FoundDevice> findDevices() {
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

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

bool matches(const DeviceInfo& info, const std::string& selector) {
  int index = -1;
  const auto [end, error] = std::from_chars(selector.data(), selector.data() + selector.size(), index);
  if (error == std::errc() && end == selector.data() + selector.size()) return index == info.index;
  const std::string wanted = lowered(selector);
  if (wanted == "cpu") return info.kind == DeviceKind::Cpu;
  if (wanted == "gpu") return info.kind == DeviceKind::Gpu;
  return lowered(info.platform + " " + info.name).find(wanted) != std::string::npos;
}

/// Loaders of platforms do not say why they found none.
bool addressSpaceIsLimited() {
  rlimit limit{};
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

const FoundDevice& choose(const std::vector<FoundDevice>& devices,
                          const std::optional<std::string>& selector) {
  if (devices.empty() && addressSpaceIsLimited())
    throw Error(ExitCode::OutOfMemory, "OpenCL", "no platform could be loaded into a limited address space",
                "raise the limit with ulimit -v");
  if (devices.empty())
    throw Error(ExitCode::NoDevice, "OpenCL", "no platform with a device was found",
                "install one: Debian's pocl-opencl-icd runs on any CPU; GPUs have drivers of their own");
  if (!selector) {
    const auto gpu = std::find_if(devices.begin(), devices.end(),
                                  [](const FoundDevice& d) { return d.info.kind == DeviceKind::Gpu; });
    return gpu != devices.end() ? *gpu : devices.front();
  }
  for (const auto& device : devices)
    if (matches(device.info, *selector)) return device;
  std::string known;
  for (const auto& device : devices)
    known += fmt::format("{}{}: {} {}", known.empty() ? "" : ", ", device.info.index, device.info.platform,
                         device.info.name);
  throw Error(ExitCode::NoDevice, "DeviceOptions::selector " + *selector, "no such device, there is " + known,
              "give an index, 'cpu', 'gpu' or a part of a name");
}

}  // namespace

std::vector<DeviceInfo> listDevices() {
  std::vector<DeviceInfo> infos;
  for (const auto& device : findDevices()) infos.push_back(device.info);
  return infos;
}

Device Device::open(const DeviceOptions& options) {
  const auto devices = findDevices();
  const FoundDevice& chosen = choose(devices, options.selector);
  try {
    return Device(std::make_unique<DeviceContext>(
        std::make_unique<OpenClContext>(chosen.device, chosen.info, options)));
  } catch (const cl::Error& error) {
    throw Error(isOutOfMemory(error) ? ExitCode::OutOfMemory : ExitCode::NoDevice, chosen.info.name,
                fmt::format("cannot be opened: {} ({})", error.what(), error.err()),
                "choose another DeviceOptions::selector");
  }
}

Device::Device(std::unique_ptr<DeviceContext> context) : context_(std::move(context)) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

const DeviceInfo& Device::info() const { return context_->info(); }

}  // namespace prelight
