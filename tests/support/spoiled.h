#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <vector>

namespace prelight::test {

/// Overwrites some bytes with values that no index, count or number may have.
inline void spoil(std::vector<std::byte>& payload, std::mt19937& random) {
  constexpr std::array<std::size_t, 4> lengths = {1, 4, 8, 2048};
  const std::size_t length = std::min(lengths[random() % lengths.size()], payload.size() / 2);
  const std::size_t at = random() % (payload.size() - length) / 4 * 4;
  constexpr std::array<int, 4> fills = {0xff, 0x7f, 0x00, -1};
  const int fill = fills[random() % fills.size()];
  for (std::size_t i = 0; i < length; ++i)
    payload[at + i] = static_cast<std::byte>(fill < 0 ? random() & 0xffu : static_cast<unsigned>(fill));
}

}  // namespace prelight::test
