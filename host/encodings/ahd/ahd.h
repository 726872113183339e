#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Ambient, highlight and direction: ambient light and one lamp, [direction, ambient, highlight][3].
/// Irradiance is ambient + highlight max(n.d, 0).
Encoding ahdEncoding();

}  // namespace prelight
