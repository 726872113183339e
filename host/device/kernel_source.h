#pragma once

#include <map>
#include <string>

namespace prelight {

/// Returns the texts of the embedded OpenCL files by their path under kernels/ ("bvh/trace.cl").
const std::map<std::string, std::string>& kernelSources();

/// Resolves `#include "path"` of an embedded kernel file from `sources` and marks every change of file with
/// `#line N "file"`, so that build logs name real files. Include guards and #if are left to the device
/// compiler: every include line is resolved, whichever branch it stands in. Throws Error naming the including
/// file and line when a file is missing.
std::string expandKernelSource(const std::string& file, const std::map<std::string, std::string>& sources);

/// Rewrites the log of a device compiler that ignores `#line`, as NVIDIA's does: each `<kernel>:N` becomes
/// the file and line that line N of the expanded source comes from.
std::string nameSourceFiles(const std::string& log, const std::string& expanded);

}  // namespace prelight
