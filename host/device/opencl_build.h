#pragma once

#include <string>

#include "device/opencl.h"
#include "device/opencl_errors.h"
#include "prelight/device.h"
#include "prelight/error.h"

namespace prelight {

/// Builds a program for a device. Throws Error (OutOfMemory) for lack of memory, else cl::Error. After lack
/// of memory the program is abandoned rather than released, because PoCL 3.1 keeps a lock on it then, and any
/// call on the program, including its release, would wait forever.
inline void buildProgram(cl::Program& program, const cl::Device& device, const DeviceInfo& info,
                         const std::string& options) {
  try {
    program.build({device}, options.c_str());
  } catch (const cl::Error& error) {
    if (!isOutOfMemory(error)) throw;
    program() = nullptr;
    throw Error(ExitCode::OutOfMemory, info.name, "no memory to build a kernel",
                "close other programs, or choose another DeviceOptions::selector");
  } catch (...) {  // PoCL lets exceptions of LLVM through
    program() = nullptr;
    throw;
  }
}

}  // namespace prelight
