#pragma once

#include <vector>

#include "basis/cube_map.h"
#include "prelight/picture.h"

namespace prelight::sh {

/// Projects a sky whose radiance is constant over each texel: L_i = sum L(texel) integral_texel Y_i dw, exact
/// up to rounding even for few texels. Returns [channel][i], 3 x order^2. Throws UsageError for a bad order,
/// InputError for a map without texels or with a texel that is negative or not finite.
std::vector<double> projectEnvironment(const Environment& environment, int order);

/// Projects a cube map in this way. Also throws what checkCubeMap() throws.
std::vector<double> projectEnvironment(const CubeMap& map, int order);

/// Returns the integrals of the functions over every texel of a cube map, exact up to rounding: [texel][i].
/// Throws UsageError for a bad order or face size.
std::vector<double> cubeTexelIntegrals(int faceSize, int order);

}  // namespace prelight::sh
