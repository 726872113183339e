#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace prelight {

/// A normal at which encodings are fitted.
struct FitNormal {
  glm::dvec3 direction{0.0, 0.0, 1.0};  ///< relative to the frame, whose z axis is the surface's own normal
  /// Cosine-weighted, as normal maps rarely lean towards the horizon; all weights sum to 1.
  double weight = 0.0;
};

constexpr std::size_t fitNormalCount = 72;

/// A quadrature rule on the hemisphere over the surface, for the weight max(z, 0) / pi: exact for polynomials
/// of degree 10 in the direction.
const std::array<FitNormal, fitNormalCount>& fitNormals();

/// Irradiance, W/m2, [fit normal].
using FitIrradiance = std::array<glm::dvec3, fitNormalCount>;

/// Returns the irradiance due to the light that an encoding is given (Encoding::encode): its SH convolved
/// with a cosine.
FitIrradiance fitIrradiance(std::span<const float> incident, const glm::mat3& frame);

}  // namespace prelight
