#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Vector occluders. nullptr where the request has none.
std::unique_ptr<Projector> vectorOccludersProjector(const BakeContext& context);

}  // namespace prelight
