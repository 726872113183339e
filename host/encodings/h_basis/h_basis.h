#pragma once

#include <array>
#include <glm/glm.hpp>

#include "encodings/encoding.h"

namespace prelight {

/// The six functions of the H-basis (Habel and Wimmer 2010), orthonormal over the hemisphere: 1 to 4 are of
/// degree 1 in the direction (relative to the frame), 5 and 6 of degree 2.
std::array<float, 6> hBasis(const glm::vec3& direction);

/// Irradiance in the first `functions` (4 or 6) functions, [function][channel].
Encoding hBasisEncoding(int functions);

}  // namespace prelight
