#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// ZH3 (Roughton et al. 2024): spherical harmonics of order 2, [coefficient][channel], and the coefficient
/// [channel] of the quadratic zonal harmonic about the axis of the luminance's linear band.
Encoding zh3Encoding();

/// The same without that coefficient, which the linear and constant bands give instead: K = F r (0.08 + 0.6
/// r) for a constant coefficient F and a linear part along the axis of r F.
Encoding zh3HallucinatedEncoding();

}  // namespace prelight
