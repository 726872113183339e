#pragma once

#include <glm/glm.hpp>

#include "basis/cube_map.h"
#include "basis/haar.h"

namespace prelight::haar {

/// Evaluates functions in wavelets at a direction, smoothed over about four by four texels, which takes the
/// noise and the steps of single texels out.
class DirectionFilter {
 public:
  /// Throws UsageError for a size that checkCubeFaceSize() refuses.
  explicit DirectionFilter(int faceSize);

  /// A light of irradiance 1 from about a direction.
  struct Light {
    SparseRow coefficients;  ///< as transformLight() gives them, exact zeros left out
    double open = 0.0;  ///< what an open receiver makes of it: the mean of max(cosine, 0) / pi over the light
  };

  /// `normal` is that of the receiver.
  Light towards(const glm::dvec3& direction, const glm::dvec3& normal) const;

 private:
  int faceSize_;
  int blockSize_;      ///< texels along a side of the blocks that are interpolated
  CubeTexels blocks_;  ///< texels of the size of blocks
};

}  // namespace prelight::haar
