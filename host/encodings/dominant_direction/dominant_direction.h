#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Lamps in the dominant directions, `lamps` of them (1 to 3), and what remains without them as a hemisphere
/// of two colours over the surface's normal: [directions, above, below, lamps][3].
Encoding dominantDirectionEncoding(std::size_t lamps);

}  // namespace prelight
