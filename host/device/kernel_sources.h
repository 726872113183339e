#pragma once

#include <map>
#include <string>

namespace prelight {

/// Texts of the embedded OpenCL files by path under kernels/ ("bvh/trace.cl").
const std::map<std::string, std::string>& kernelSources();

}  // namespace prelight
