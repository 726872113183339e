#pragma once

#include <cstdint>

#include "prelight/techniques.h"

namespace prelight {

/// Bytes per triangle of nodes and blocks on the device; measurements give 65 to 95.
constexpr std::uint64_t treeBytesPerTriangle = 80;

/// Returns whether techniques cast rays of their own after the shared cast, so that the trees must stay until
/// then.
inline bool keepsTrees(const BakeRequest& request) {
  return request.volume.size > 0 || request.chartTransfer.size > 0 || request.lightMap || request.radiosity;
}

}  // namespace prelight
