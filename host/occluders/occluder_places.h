#pragma once

#include <algorithm>
#include <cstddef>

#include "bake/transfer.h"

namespace prelight {

/// Where a vector lies in a transfer's records; stored.size() when it is not stored.
inline std::size_t placeOf(const OccluderTransfer& transfer, OccluderVector vector) {
  const auto found = std::find(transfer.stored.begin(), transfer.stored.end(), vector);
  return static_cast<std::size_t>(found - transfer.stored.begin());
}

}  // namespace prelight
