#include "device/host_memory.h"

#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace prelight {

void* allocateHostMemory(std::size_t bytes) {
  const std::size_t rounded = (bytes + hugePageSize - 1) / hugePageSize * hugePageSize;
  void* memory = std::aligned_alloc(hugePageSize, rounded);
#ifdef __linux__
  // A refusal costs speed only.
  if (memory != nullptr) madvise(memory, rounded, MADV_HUGEPAGE);
#endif
  return memory;
}

void releaseHostMemory(void* memory) { std::free(memory); }

}  // namespace prelight
