#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Radiosity normal mapping (McTaggart 2004), the basis of Half-Life 2: irradiance along three vectors at
/// right angles to one another over the surface, [vector][channel], each weighted by the squared cosine to
/// the normal, in shares of the sum of all three.
Encoding halfLife2Encoding();

}  // namespace prelight
