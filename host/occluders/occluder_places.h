#pragma once

#include <algorithm>
#include <cstddef>

#include "prelight/transfer.h"

namespace prelight {

/// Returns whether a vector is a sum over a share of the hemisphere, which scales and turns with it; other
/// vectors are means.
inline bool isSum(OccluderVector vector) {
  return vector == OccluderVector::Occlusion || vector == OccluderVector::Caustic ||
         vector == OccluderVector::DiffuseNormal || vector == OccluderVector::SpecularNormal;
}

/// Returns the index of a vector in a transfer's records, or stored.size() if it is not stored.
inline std::size_t placeOf(const OccluderTransfer& transfer, OccluderVector vector) {
  const auto found = std::find(transfer.stored.begin(), transfer.stored.end(), vector);
  return static_cast<std::size_t>(found - transfer.stored.begin());
}

}  // namespace prelight
