#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Diffuse transfer in spherical harmonics. nullptr where the request has none.
std::unique_ptr<Projector> shProjector(const BakeContext& context);

}  // namespace prelight
