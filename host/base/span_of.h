#pragma once

#include <span>
#include <vector>

namespace prelight {

/// Returns a vector's elements as a span, with the type deduced where a span of T is expected.
template <typename T>
std::span<const T> spanOf(const std::vector<T>& values) {
  return values;
}

}  // namespace prelight
