#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Radiosity normal mapping (McTaggart 2004), the basis of Half-Life 2: irradiance along three orthogonal
/// vectors over the surface, [vector][channel], weighted by the squared cosines to the normal, normalised to
/// a sum of 1.
Encoding halfLife2Encoding();

}  // namespace prelight
