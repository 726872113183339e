#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Ambient, highlight and direction: light of no direction and a lamp, [direction, ambient, highlight][3],
/// ambient + highlight max(n.d, 0).
Encoding ahdEncoding();

}  // namespace prelight
