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
  std::vector<std::uint32_t> sources;  ///< texels that it is made of
  std::vector<float> weights;          ///< parallel to sources; add up to 1 in a row

  CubeMap apply(const CubeMap& map) const;
};

/// The rotated function f'(w) = f(R^-1 w) as means over texels: weights are the exact overlaps with the
/// rotated texels. Keeps flux. `rotation` is orthonormal.
CubeResampling rotateByArea(const glm::dmat3& rotation, int faceSize);

/// The value at the one source texel that the centre of a texel came from (Sherif 6.6.3). Does not keep flux
/// and jumps as the rotation grows; kept to show the difference.
CubeResampling rotateByPoint(const glm::dmat3& rotation, int faceSize);

}  // namespace prelight
