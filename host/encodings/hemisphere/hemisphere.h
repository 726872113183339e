#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Hemisphere lighting: two colours along the axis of the surface's own normal N, [N, -N][channel], mixed by
/// (1 + n.N) / 2. This is exact for an even sky over the surface, which a vertical axis in world space would
/// miss on walls.
Encoding hemisphereEncoding();

}  // namespace prelight
