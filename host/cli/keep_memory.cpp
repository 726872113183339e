#include "cli/keep_memory.h"

#include <limits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace prelight::cli {

void keepFreedMemory() {
#ifdef __GLIBC__
  constexpr int largestThreshold = 32 << 20;  // glibc takes no more
  mallopt(M_MMAP_THRESHOLD, largestThreshold);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace prelight::cli
