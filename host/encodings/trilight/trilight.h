#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Trilight (Forsyth 2003): a direction, and the irradiance of normals along, across and against it,
/// [direction, along, across, against][3].
Encoding trilightEncoding();

}  // namespace prelight
