#pragma once

#include <map>
#include <string>

#include "device/context.h"

namespace prelight {

/// Texts of the laboratory's OpenCL files by path under benchmarks/ ("lab/kernels/grid_kernels.cl").
const std::map<std::string, std::string>& labKernelSources();

/// Registers the laboratory's OpenCL files with the device. Returns the path of `file` ("grid_kernels.cl")
/// from which kernels are built.
std::string labKernel(DeviceContext& device, const std::string& file);

}  // namespace prelight
