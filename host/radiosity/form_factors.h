#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/elements.h"
#include "radiosity/form_factor_cast.h"

namespace prelight {

/// Sparse rows of form factors F_ij = scale_i S_ij, the share of the power leaving element i that arrives at
/// j. S is symmetric, so that A_i F_ij = A_j F_ji up to the scales, which make each row plus the sky's share
/// sum to exactly 1.
struct FormFactors {
  std::vector<std::uint32_t> rowStart;  ///< [element + 1]; rows of elements that were not cast from are empty
  std::vector<std::uint32_t> columns;   ///< ascending within a row
  std::vector<float> values;            ///< S, m2
  std::vector<float> scale;             ///< [element], 1/m2, about 1 / area
  std::vector<float> areas;             ///< [element], m2, valid area only
  std::vector<float> escaped;           ///< [element], share that leaves the scene
  std::vector<glm::vec3> albedo;        ///< [element]
  bool backs = false;                   ///< whether the elements include those of the backs

  std::uint32_t elementCount() const { return static_cast<std::uint32_t>(areas.size()); }
  bool isCast(std::uint32_t element) const { return scale[element] > 0.0f; }
};

/// Combines the counts of both directions: A_i F_ij is estimated from i and from j, and the sum of both
/// counts over the sum of their ray densities is the estimate of least variance. The result is balanced to
/// correct row sums by Sinkhorn's iteration, which keeps symmetry. If no ray hit a back, only fronts are
/// elements. Throws Error (OutOfMemory) when more than `maxMemory` bytes would be needed.
FormFactors makeFormFactors(const RadiosityElements& elements, const ExchangeCounts& counts,
                            std::uint64_t maxMemory);

}  // namespace prelight
