#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace prelight {

/// Calls use(first, count) for consecutive pieces of [0, count) of about four megabytes each, for elements of
/// `elementSize` bytes.
template <typename Use>
void forPieces(std::uint64_t count, std::size_t elementSize, const Use& use) {
  constexpr std::size_t pieceBytes = std::size_t{1} << 22;
  const std::uint64_t most = std::max<std::uint64_t>(1, pieceBytes / std::max<std::size_t>(1, elementSize));
  for (std::uint64_t first = 0; first < count; first += most) use(first, std::min(most, count - first));
}

}  // namespace prelight
