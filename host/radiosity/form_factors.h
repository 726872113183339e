#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/elements.h"
#include "radiosity/form_factor_cast.h"

namespace prelight {

/// Sparse rows of form factors F_ij = scale_i S_ij: of what leaves element i, the share that arrives at j. S
/// is symmetric, so that A_i F_ij = A_j F_ji up to the scales, which bring every row with the sky's share to
/// exactly 1.
struct FormFactors {
  std::vector<std::uint32_t> rowStart;  ///< [element + 1]; a row is empty where nothing was cast
  std::vector<std::uint32_t> columns;   ///< ascending within a row
  std::vector<float> values;            ///< S, m2
  std::vector<float> scale;             ///< [element], 1/m2, about 1 / area
  std::vector<float> areas;             ///< [element], m2, without what does not count
  std::vector<float> escaped;           ///< [element], share that leaves the scene
  std::vector<glm::vec3> albedo;        ///< [element]
  bool backs = false;                   ///< the elements include those of the backs

  std::uint32_t elementCount() const { return static_cast<std::uint32_t>(areas.size()); }
  bool isCast(std::uint32_t element) const { return scale[element] > 0.0f; }
};

/// Joins what was counted in both directions: A_i F_ij is estimated from i and from j, and the sum of both
/// counts over the sum of their densities of rays is the estimate of least variance. The result is balanced
/// to rows that add up (Sinkhorn's iteration, which keeps symmetry). Where no ray met a back, the elements
/// are those of the fronts alone. Throws Error (OutOfMemory) when it would take more than `maxMemory` bytes.
FormFactors makeFormFactors(const RadiosityElements& elements, const ExchangeCounts& counts,
                            std::uint64_t maxMemory);

}  // namespace prelight
