#pragma once

#include "techniques/projector.h"

namespace prelight {

/// Diffuse transfer in cpherical harmonics. nullptr where the request has none.
std::unique_ptr<Projector> chProjector(const BakeContext& context);

}  // namespace prelight
