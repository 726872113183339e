#include "prelight/device.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <utility>

#include "prelight/error.h"
#include "python/module.h"
#include "python/progress.h"
#include "python/unlocked_work.h"

namespace prelight::python {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

/// Returns the selector for a name, a part of a name, or a number.
std::optional<std::string> selectorOf(nb::handle given) {
  if (given.is_none()) return std::nullopt;
  std::string name;
  std::int64_t index = 0;
  if (nb::try_cast(given, name)) return name;
  if (!nb::isinstance<nb::bool_>(given) && nb::try_cast(given, index)) return std::to_string(index);
  throw UsageError("Device: selector", std::string("got ") + nb::repr(given).c_str() +
                                           ", expected an index into devices() or a part of a name");
}

/// Passes on the warnings of devices, which outlive the calls that have a progress of their own.
struct DeviceWarnings final : Progress {
  void warn(std::string_view warning) override { warnInPython(warning); }
};

Device openDevice(const std::optional<std::string>& selector) {
  static DeviceWarnings warnings;
  const UnlockedWork unlocked;
  return Device::open({.selector = selector, .progress = &warnings});
}

}  // namespace

void bindDevices(nb::module_& module) {
  nb::enum_<DeviceKind>(module, "DeviceKind")
      .value("cpu", DeviceKind::Cpu)
      .value("gpu", DeviceKind::Gpu)
      .value("other", DeviceKind::Other);
  nb::class_<DeviceInfo>(module, "DeviceInfo", "An OpenCL device.")
      .def_ro("index", &DeviceInfo::index)
      .def_ro("kind", &DeviceInfo::kind)
      .def_ro("name", &DeviceInfo::name)
      .def_ro("vendor", &DeviceInfo::vendor)
      .def_ro("platform", &DeviceInfo::platform)
      .def_ro("driver_version", &DeviceInfo::driverVersion)
      .def_ro("compute_units", &DeviceInfo::computeUnits)
      .def_ro("global_memory", &DeviceInfo::globalMemory, "Bytes.");
  nb::class_<Device>(module, "Device", "An open device, which several calls can share.")
      .def(
          "__init__",
          [](Device* place, nb::handle selector) { new (place) Device(openDevice(selectorOf(selector))); },
          "selector"_a = nb::none(), nb::sig("def __init__(self, selector: str | int | None = None) -> None"),
          "`selector`: index or part of the name; None: the first GPU, else the first device.")
      .def_prop_ro("info", &Device::info, nb::rv_policy::reference_internal);
  module.def("devices", &listDevices, "All devices of all platforms; empty without OpenCL.");
}

}  // namespace prelight::python
