#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Hemisphere lighting: two colours over the axis of the surface's own normal N, [N, -N][channel], mixed by
/// (1 + n.N) / 2. This is what an even sky over the surface makes, which an axis that points up in the world
/// would miss on walls.
Encoding hemisphereEncoding();

}  // namespace prelight
