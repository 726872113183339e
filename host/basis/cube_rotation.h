#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "basis/cube_map.h"

namespace prelight {

/// A linear map from the texels of a cube map to those of a rotated one, as sparse rows.
struct CubeResampling {
  int faceSize = 0;
  std::vector<std::uint32_t> offsets;  ///< [texel of the result], then the end
  std::vector<std::uint32_t> sources;  ///< source texels of each result
  std::vector<float> weights;          ///< [source] weights, whose sum per row is 1

  CubeMap apply(const CubeMap& map) const;
};

/// Returns the map to the rotated function f'(w) = f(R^-1 w) as means over texels: weights are the exact
/// overlaps with the rotated texels. Preserves flux. `rotation` is orthonormal.
CubeResampling rotateByArea(const glm::dmat3& rotation, int faceSize);

/// Returns the map that takes the value of the one source texel from which the centre of a texel came (Sherif
/// 6.6.3). It does not preserve flux and jumps as the rotation grows; it exists to show the difference.
CubeResampling rotateByPoint(const glm::dmat3& rotation, int faceSize);

}  // namespace prelight
