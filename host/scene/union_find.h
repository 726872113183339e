#pragma once

#include <cstdint>
#include <vector>

namespace prelight {

/// Returns the root of a member's set and shortens the path to it. parents: for each member another one of
/// its set, or itself for roots.
inline std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t member) {
  while (parents[member] != member) member = parents[member] = parents[parents[member]];
  return member;
}

}  // namespace prelight
