#pragma once

#include <sys/resource.h>

namespace prelight {

/// Returns whether `ulimit -v` is in effect. OpenCL runtimes and compilers then crash or find no platform,
/// without saying why.
inline bool addressSpaceIsLimited() {
  rlimit limit{};
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

}  // namespace prelight
