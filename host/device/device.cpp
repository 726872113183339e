#include "prelight/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "device/context.h"
#include "device/opencl.h"
#include "device/opencl_context.h"
#include "device/opencl_devices.h"
#include "device/pocl.h"
#include "device/thread_check.h"
#include "prelight/error.h"

namespace prelight {

namespace {

/// Finds every device, after removing causes that would make a runtime abort as it starts.
std::vector<FoundDevice> prepareAndFind() {
  static const bool prepared = [] {
    requireThreads(threadsOfRuntime());
    replaceUnusablePoclCache();
    return true;
  }();
  (void)prepared;
  return findDevices();
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

const FoundDevice& choose(const std::vector<FoundDevice>& devices,
                          const std::optional<std::string>& selector) {
  // Platform loaders do not report why they found none.
  if (devices.empty() && addressSpaceIsLimited())
    throw Error(ExitCode::OutOfMemory, "OpenCL", "no platform could be loaded into a limited address space",
                "raise the limit with ulimit -v");
  if (const auto& cache = replaceUnusablePoclCache(); devices.empty() && cache && cache->folder.empty())
    throw Error(ExitCode::NoDevice, "OpenCL",
                cache->problem + "; nor can it in TMPDIR, /tmp, /var/tmp or /dev/shm",
                "set POCL_CACHE_DIR to a folder that takes them");
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
  for (const auto& device : prepareAndFind()) infos.push_back(device.info);
  return infos;
}

Device Device::open(const DeviceOptions& options) {
  const auto devices = prepareAndFind();
  const FoundDevice& chosen = choose(devices, options.selector);
  if (const auto warning = poclCacheWarning(); warning && chosen.info.isPocl && options.progress != nullptr)
    options.progress->warn(*warning);
  configurePocl(chosen.info);
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

OpenClHandles openclHandles(const Device& device) {
  const cl::CommandQueue& queue = device.context().opencl().queue({});
  return {queue.getInfo<CL_QUEUE_CONTEXT>()(), queue.getInfo<CL_QUEUE_DEVICE>()(), queue()};
}

}  // namespace prelight
