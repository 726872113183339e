#pragma once

#include "techniques/projector.h"

namespace prelight {

/// SH transfer of points in the air. Throws UsageError without an order of SH; nullptr where the request has
/// none.
std::unique_ptr<Projector> volumeProjector(const BakeContext& context);

}  // namespace prelight
