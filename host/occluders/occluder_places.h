#pragma once

#include <algorithm>
#include <cstddef>

#include "prelight/transfer.h"

namespace prelight {

/// A vector that is a sum over a share of the sky, and so scales and turns with it; the others are means.
inline bool isSum(OccluderVector vector) {
  return vector == OccluderVector::Occlusion || vector == OccluderVector::Caustic ||
         vector == OccluderVector::DiffuseNormal || vector == OccluderVector::SpecularNormal;
}

/// Where a vector lies in a transfer's records; stored.size() when it is not stored.
inline std::size_t placeOf(const OccluderTransfer& transfer, OccluderVector vector) {
  const auto found = std::find(transfer.stored.begin(), transfer.stored.end(), vector);
  return static_cast<std::size_t>(found - transfer.stored.begin());
}

}  // namespace prelight
