#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// A lamp in the dominant direction and what remains without it as a hemisphere of two colours over the
/// surface's normal: [direction, above, below, lamp][3].
Encoding dominantDirectionEncoding();

}  // namespace prelight
