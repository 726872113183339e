#pragma once

#include <string>

#include "device/opencl.h"
#include "device/opencl_errors.h"
#include "prelight/device.h"
#include "prelight/error.h"

namespace prelight {

/// Builds a program for a device. Throws Error (OutOfMemory) for want of memory, cl::Error for the rest. A
/// program that memory ended for is let go of and not released: PoCL 3.1 leaves its lock taken then, and
/// whoever asks anything of the program, its release included, waits for ever.
inline void buildProgram(cl::Program& program, const cl::Device& device, const DeviceInfo& info,
                         const std::string& options) {
  try {
    program.build({device}, options.c_str());
  } catch (const cl::Error& error) {
    if (!isOutOfMemory(error)) throw;
    program() = nullptr;
    throw Error(ExitCode::OutOfMemory, info.name, "no memory to build a kernel",
                "close other programs, or choose another DeviceOptions::selector");
  } catch (...) {  // LLVM's, through PoCL
    program() = nullptr;
    throw;
  }
}

}  // namespace prelight
