#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Ambient cube (McTaggart 2004): irradiance along the six directions +x, -x, +y, -y, +z, -z of the world,
/// [direction][channel], each weighted by the square of the normal's component.
Encoding ambientCubeEncoding();

}  // namespace prelight
