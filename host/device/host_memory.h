#pragma once

#include <cstddef>

namespace prelight {

/// Size of a huge page in bytes. Buffers of CPU devices from this size on lie on huge pages where the system
/// grants them, which saves a traversal most of its address translations.
constexpr std::size_t hugePageSize = std::size_t{2} << 20;

/// Allocates `bytes` rounded up to huge pages. Returns null when there is no memory. Release with
/// releaseHostMemory().
void* allocateHostMemory(std::size_t bytes);
void releaseHostMemory(void* memory);

}  // namespace prelight
