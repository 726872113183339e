#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Spherical harmonics of order 2, [coefficient][channel], taken for an even sky over the surface and one far
/// lamp a channel: what light maps do with their directions (docs/lightmaps.md, "Normal maps").
Encoding skyAndLampEncoding();

}  // namespace prelight
