#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace prelight {

template <typename T>
std::size_t bytesOf(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

/// "1 key", "2 keys".
std::string counted(std::size_t count, const char* one);

/// "3 channels, 1 bounce".
std::string channelsText(int channels, int bounces);

}  // namespace prelight
