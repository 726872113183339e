#pragma once

#include <span>
#include <vector>

namespace prelight {

/// A vector's elements, with the type deduced where a span of T is wanted.
template <typename T>
std::span<const T> spanOf(const std::vector<T>& values) {
  return values;
}

}  // namespace prelight
