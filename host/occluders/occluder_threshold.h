#pragma once

#include "prelight/transfer.h"

namespace prelight {

/// Form factor of dropped occluders, a share of the hemisphere that counts as unoccluded from then on.
struct DroppedOccluders {
  double mean = 0.0;  ///< mean over vertices
  double most = 0.0;  ///< largest of a vertex
};

/// Removes records whose form factor is below `leastFormFactor`.
DroppedOccluders dropOccluders(OccluderTransfer& transfer, double leastFormFactor);

}  // namespace prelight
