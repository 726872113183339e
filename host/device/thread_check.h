#pragma once

#include <cstddef>

namespace prelight {

/// Threads that an OpenCL runtime on this machine's processors starts: one each, or as many as PoCL's
/// environment variables allow.
std::size_t threadsOfRuntime();

/// Starts so many threads at once and ends them. Throws Error(OutOfMemory) naming the count when the system
/// does not give them: PoCL would abort.
void requireThreads(std::size_t count);

}  // namespace prelight
