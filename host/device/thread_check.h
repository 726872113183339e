#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace prelight {

/// Returns whether `ulimit -v` is in effect. OpenCL runtimes and compilers then crash or find no platform,
/// without saying why.
inline bool addressSpaceIsLimited() {
  rlimit limit{};
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

/// Returns the number of threads that an OpenCL runtime starts: one per processor, or as many as PoCL's
/// environment variables allow.
std::size_t threadsOfRuntime();

/// Starts `count` threads at once and ends them. Throws Error(OutOfMemory) naming the count when the system
/// refuses: PoCL would abort.
void requireThreads(std::size_t count);

}  // namespace prelight
