#pragma once

#include <cstdint>

#include "prelight/request.h"

namespace prelight {

/// On the device, nodes and blocks; measured 65 to 95.
constexpr std::uint64_t treeBytesPerTriangle = 80;

/// Whether techniques trace rays of their own after receivers have cast theirs: the trees stay until then.
inline bool keepsTrees(const BakeRequest& request) {
  return request.volume.size > 0 || request.chartTransfer.size > 0 || request.lightMap || request.radiosity;
}

}  // namespace prelight
