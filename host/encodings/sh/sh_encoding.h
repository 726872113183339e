#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// Spherical harmonics of order 2 or 3: the first bands of incident radiance itself, [coefficient][channel],
/// whose irradiance follows by the clamped cosine's zonal coefficients (Ramamoorthi and Hanrahan 2001).
Encoding shEncoding(int order);

}  // namespace prelight
