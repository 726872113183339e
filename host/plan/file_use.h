#pragma once

#include <cstdint>

#include "prelight/techniques.h"

namespace prelight {

/// Returns whether a scene's file of `bytes` should be moved out of memory during the bake. Only charts are
/// made from the file then; everything else uses the compiled scene.
inline bool fileWaits(const BakeRequest& request, std::uint64_t bytes) {
  constexpr std::uint64_t large = std::uint64_t{32} << 20;
  return bytes >= large && !request.lightMap && request.chartTransfer.size == 0;
}

}  // namespace prelight
