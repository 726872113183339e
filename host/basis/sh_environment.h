#pragma once

#include <vector>

#include "basis/cube_map.h"
#include "prelight/picture.h"

namespace prelight::sh {

/// Projection of a sky whose radiance is constant over each texel: L_i = sum L(texel) integral_texel Y_i dw,
/// exact up to rounding however few texels there are. Returns [channel][i], 3 x order^2. Throws UsageError
/// for a bad order, InputError for a map without texels or with a texel that is negative or not finite.
std::vector<double> projectEnvironment(const Environment& environment, int order);

/// The same for a cube map. Throws as well what checkCubeMap() throws.
std::vector<double> projectEnvironment(const CubeMap& map, int order);

/// Integrals of the functions over every texel of a cube map, exact up to rounding: [texel][i]. Throws
/// UsageError for a bad order or face size.
std::vector<double> cubeTexelIntegrals(int faceSize, int order);

}  // namespace prelight::sh
