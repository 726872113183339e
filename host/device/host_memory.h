#pragma once

#include <cstddef>

namespace prelight {

/// Memory of the host that a CPU device's buffer lies in: on huge pages where the system grants them, which
/// spares a traversal most of its address translations. From this size on, bytes.
constexpr std::size_t hugePageSize = std::size_t{2} << 20;

/// Returns `bytes` rounded up to huge pages, or null when there is no memory; given back by
/// releaseHostMemory.
void* allocateHostMemory(std::size_t bytes);
void releaseHostMemory(void* memory);

}  // namespace prelight
