#pragma once

#include <fmt/format.h>

#include <new>
#include <string>
#include <utility>

#include "prelight/device.h"
#include "prelight/error.h"

// The only header that includes the OpenCL C++ bindings. Prelight needs only version 1.2.
#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <CL/opencl.hpp>
#pragma GCC diagnostic pop

namespace prelight {

/// Returns whether an error means lack of memory, on the device or on the host.
inline bool isOutOfMemory(const cl::Error& error) {
  return error.err() == CL_MEM_OBJECT_ALLOCATION_FAILURE || error.err() == CL_OUT_OF_RESOURCES ||
         error.err() == CL_OUT_OF_HOST_MEMORY;
}

/// Calls the new handler (std::set_new_handler), if any, when the runtime found no host memory. The runtime
/// may still hold locks then, so that destructors would wait forever.
inline void tellOfMissingMemory(const cl::Error& error) {
  if (error.err() != CL_OUT_OF_HOST_MEMORY) return;
  if (const std::new_handler end = std::get_new_handler()) end();
}

/// The advice of errors after which the runtime may no longer answer.
constexpr const char* whenDeviceFails = "run it again, or choose another DeviceOptions::selector";

/// Returns the error that the caller gets for a failed call of the runtime.
inline Error errorOf(const cl::Error& error) {
  if (isOutOfMemory(error)) {
    tellOfMissingMemory(error);
    return {ExitCode::OutOfMemory, "OpenCL",
            fmt::format("{} found no memory ({})", error.what(), error.err()),
            "give the bake less with BakeRequest::maxMemory, or close other programs"};
  }
  return {ExitCode::RuntimeFailure, "OpenCL",
          fmt::format("{} failed ({}), as when a device is lost", error.what(), error.err()),
          whenDeviceFails};
}

/// Runs calls of the runtime. Throws errorOf() what they throw.
template <typename Call>
decltype(auto) calling(Call&& call) {
  try {
    return std::forward<Call>(call)();
  } catch (const cl::Error& error) {
    throw errorOf(error);
  }
}

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
