#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Diffuse transfer in Haar wavelets. nullptr where the request has none.
std::unique_ptr<Projector> haarProjector(const BakeContext& context);

}  // namespace prelight
