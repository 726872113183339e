#pragma once

#include <map>
#include <string>

namespace prelight {

/// Returns the texts of the embedded OpenCL files by their path under kernels/ ("bvh/trace.cl").
const std::map<std::string, std::string>& kernelSources();

}  // namespace prelight
