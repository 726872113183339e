#pragma once

#include "device/device_memory.h"
#include "device/opencl.h"

namespace prelight {

struct DeviceMemory::OpenCl {
  cl::CommandQueue queue;
  cl::Buffer buffer;
};

}  // namespace prelight
