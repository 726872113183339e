#pragma once

#include <cstdint>
#include <vector>

namespace prelight {

/// Of sets whose members know another of theirs, roots themselves: the root of a member's set. Shortens ways.
inline std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t member) {
  while (parents[member] != member) member = parents[member] = parents[parents[member]];
  return member;
}

}  // namespace prelight
