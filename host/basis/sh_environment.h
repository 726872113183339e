#pragma once

#include <vector>

#include "io/environment.h"

namespace prelight::sh {

/// Projection of a sky whose radiance is constant over each texel: L_i = sum L(texel) integral_texel Y_i dw,
/// exact up to rounding however few texels there are. Returns [channel][i], 3 x order^2.
std::vector<double> projectEnvironment(const Environment& environment, int order);

}  // namespace prelight::sh
