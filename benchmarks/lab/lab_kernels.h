#pragma once

#include <map>
#include <string>

#include "device/context.h"

namespace prelight {

/// Texts of the laboratory's OpenCL files by path under benchmarks/ ("lab/kernels/dense_kernels.cl").
const std::map<std::string, std::string>& labKernelSources();

/// Makes the laboratory's OpenCL files known to the device. Returns the path of `file`, "dense_kernels.cl",
/// to build kernels from.
std::string labKernel(DeviceContext& device, const std::string& file);

}  // namespace prelight
