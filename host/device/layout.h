#pragma once

#include <string>
#include <vector>

#include "device/context.h"

namespace prelight {

/// Size of a shared struct and offset of its last checked field, as a compiler lays it out.
struct StructLayout {
  std::string name;
  std::uint32_t size = 0;
  std::uint32_t offset = 0;

  bool operator==(const StructLayout&) const = default;
};

/// Returns the layouts of the host's compiler, in the order of kernels/core/layout_probe_kernels.cl.
std::vector<StructLayout> hostLayouts();

/// Returns the layouts of the device's compiler, in the order of hostLayouts().
std::vector<StructLayout> deviceLayouts(DeviceContext& device);

}  // namespace prelight
