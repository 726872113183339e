#pragma once

#include <fmt/format.h>

#include <new>
#include <utility>

#include "device/opencl.h"
#include "prelight/error.h"

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

/// Runs a call of the runtime. Throws Error with ExitCode::OutOfMemory if the call found no memory.
template <typename Call>
decltype(auto) withMemory(Call&& call) {
  try {
    return std::forward<Call>(call)();
  } catch (const cl::Error& error) {
    if (!isOutOfMemory(error)) throw;
    tellOfMissingMemory(error);
    throw Error(ExitCode::OutOfMemory, "OpenCL",
                fmt::format("{} found no memory ({})", error.what(), error.err()),
                "give the bake less with BakeRequest::maxMemory, or close other programs");
  }
}

}  // namespace prelight
