#pragma once

#include <string>
#include <vector>

#include "device/context.h"

namespace prelight {

/// Size of a shared struct and offset of its last checked field, by the host's compiler.
struct StructLayout {
  std::string name;
  std::uint32_t size = 0;
  std::uint32_t offset = 0;

  bool operator==(const StructLayout&) const = default;
};

/// The host's layouts, in the order of kernels/core/layout_probe_kernels.cl.
std::vector<StructLayout> hostLayouts();

/// The same from the device's compiler.
std::vector<StructLayout> deviceLayouts(DeviceContext& device);

}  // namespace prelight
