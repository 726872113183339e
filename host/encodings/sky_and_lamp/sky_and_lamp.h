#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Spherical harmonics of order 2, [coefficient][channel], interpreted per channel as an even sky over the
/// surface and one distant lamp, as light maps do with their directions (docs/notes/lightmaps.md, "Normal
/// maps").
Encoding skyAndLampEncoding();

}  // namespace prelight
