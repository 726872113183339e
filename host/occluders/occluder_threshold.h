#pragma once

#include "prelight/transfer.h"

namespace prelight {

/// Form factor of what was dropped: a share of the sky that counts as open from then on.
struct DroppedOccluders {
  double mean = 0.0;  ///< over vertices
  double most = 0.0;  ///< of a vertex
};

/// Takes the records away whose form factor is below `leastFormFactor`.
DroppedOccluders dropOccluders(OccluderTransfer& transfer, double leastFormFactor);

}  // namespace prelight
