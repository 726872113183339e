#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "basis/cube_map.h"
#include "prelight/picture.h"

namespace prelight::sh {

using DirectionFunction = std::function<double(const glm::dvec3& direction)>;

/// Returns f_i = integral f Y_i, order^2 entries. Exact up to rounding when f is a polynomial of `degree` in
/// (x, y, z) on the unit sphere. Throws UsageError for a bad order or a negative degree, Error when f returns
/// a value that is not finite.
std::vector<double> project(const DirectionFunction& f, int degree, int order);

/// The result of projectWithin.
struct Projection {
  std::vector<double> coefficients;  ///< order^2 entries
  double error = 0.0;                ///< largest change of a coefficient when the degree was last doubled
  int degree = 0;                    ///< degree of the last quadrature
};

/// As project, for a function of unknown degree: doubles the degree until no coefficient changes by more than
/// `tolerance` (absolute, > 0), or until `largestDegree`. Compare `error` with the tolerance to see which.
/// For smooth functions the true error is far below `error`; for discontinuous ones it is about `error`.
Projection projectWithin(const DirectionFunction& f, double tolerance, int order, int largestDegree = 1024);

/// Throws InputError for a sky without texels, or with a texel that is negative or not finite.
void checkEnvironment(const Environment& environment);

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
