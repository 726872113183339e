#pragma once

#include <sys/resource.h>

namespace prelight {

/// True under `ulimit -v`: runtimes and compilers crash there, or find no platform, without saying why.
inline bool addressSpaceIsLimited() {
  rlimit limit{};
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

}  // namespace prelight
