#pragma once

#include "device/opencl.h"

namespace prelight {

/// What OpenCL calls a want of memory, on the device or beside it.
inline bool isOutOfMemory(const cl::Error& error) {
  return error.err() == CL_MEM_OBJECT_ALLOCATION_FAILURE || error.err() == CL_OUT_OF_RESOURCES ||
         error.err() == CL_OUT_OF_HOST_MEMORY;
}

}  // namespace prelight
