#pragma once

#include <cstdint>

#include "prelight/request.h"

namespace prelight {

/// Whether so many bytes of a scene's file had better lie elsewhere while it is baked. Charts alone are made
/// of them then; the rest reads the compiled scene.
inline bool fileWaits(const BakeRequest& request, std::uint64_t bytes) {
  constexpr std::uint64_t large = std::uint64_t{32} << 20;
  return bytes >= large && !request.lightMap && request.chartTransfer.size == 0;
}

}  // namespace prelight
