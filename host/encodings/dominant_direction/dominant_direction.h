#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// One to three lamps in the dominant directions, and the remaining light as a hemisphere of two colours
/// about the surface's normal: [directions, above, below, lamps][3].
Encoding dominantDirectionEncoding(std::size_t lamps);

}  // namespace prelight
