#include "cli/console/keep_memory.h"

#include <limits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace prelight::cli {

void keepFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

}  // namespace prelight::cli
