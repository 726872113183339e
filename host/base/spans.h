#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace prelight {

/// Returns a vector's elements as a span, with the type deduced where a span of T is expected.
template <typename T>
std::span<const T> spanOf(const std::vector<T>& values) {
  return values;
}

/// Returns the floats of structures that contain nothing else.
template <typename T>
std::span<const float> numbersOf(std::span<const T> structures) {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) == alignof(float) &&
                sizeof(T) % sizeof(float) == 0);
  return {reinterpret_cast<const float*>(structures.data()), structures.size() * (sizeof(T) / sizeof(float))};
}
template <typename T>
std::span<const float> numbersOf(const std::vector<T>& structures) {
  return numbersOf(spanOf(structures));
}

/// Prefetches `count` elements that will soon be read or written. A hint, which costs only time if it is
/// wrong, and does nothing if the compiler has no such instruction.
template <typename T>
inline void prefetch([[maybe_unused]] const T* first, [[maybe_unused]] std::size_t count = 1) {
#ifdef __GNUC__
  constexpr std::uintptr_t line = 64;
  const auto begin = reinterpret_cast<std::uintptr_t>(first);
  const std::uintptr_t end = begin + count * sizeof(T);
  for (std::uintptr_t at = begin - begin % line; at < end; at += line)
    __builtin_prefetch(reinterpret_cast<const void*>(at));
  asm volatile("");  // gcc removes calls of functions that only prefetch
#endif
}

}  // namespace prelight
