#pragma once

#include <cstddef>

namespace prelight {

/// Returns the number of threads that an OpenCL runtime starts: one per processor, or as many as PoCL's
/// environment variables allow.
std::size_t threadsOfRuntime();

/// Starts `count` threads at once and ends them. Throws Error(OutOfMemory) naming the count when the system
/// refuses: PoCL would abort.
void requireThreads(std::size_t count);

}  // namespace prelight
