#pragma once

#include <cstddef>
#include <cstdint>

namespace prelight {

/// Asks for the memory of `count` elements that are soon read or written. A hint: costs nothing but time
/// where it is wrong, and does nothing where the compiler has no such instruction.
template <typename T>
inline void prefetch([[maybe_unused]] const T* first, [[maybe_unused]] std::size_t count = 1) {
#ifdef __GNUC__
  constexpr std::uintptr_t line = 64;
  const auto begin = reinterpret_cast<std::uintptr_t>(first);
  const std::uintptr_t end = begin + count * sizeof(T);
  for (std::uintptr_t at = begin - begin % line; at < end; at += line)
    __builtin_prefetch(reinterpret_cast<const void*>(at));
  asm volatile("");  // gcc leaves out calls of functions that do nothing but prefetch
#endif
}

}  // namespace prelight
