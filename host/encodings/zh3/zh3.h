#pragma once

#include "encodings/encoding.h"

namespace prelight {

/// ZH3 (Roughton et al. 2024): spherical harmonics of order 2, [coefficient][channel], and per [channel] the
/// coefficient of the quadratic zonal harmonic about the axis of the luminance's linear band.
Encoding zh3Encoding();

/// ZH3 without the stored zonal coefficient K, which follows from the lower bands: K = F r (0.08 + 0.6 r) for
/// a constant coefficient F and a linear part r F along the axis.
Encoding zh3HallucinatedEncoding();

}  // namespace prelight
