#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "encodings/encoding.h"

namespace prelight {

/// Lobes exp(sharpness (v.d - 1)) with fixed directions d and one sharpness.
struct GaussianLobes {
  std::vector<glm::vec3> directions;  ///< relative to the frame, over the hemisphere
  float sharpness = 0.0f;
  /// Irradiance of a lobe of radiance 1 as a polynomial in the cosine x between its direction and the normal:
  /// p0 + p1 x + p2 x^2 + p3 x^4 + p4 x^6 + p5 x^8.
  std::array<float, 6> irradiance{};
};

/// Returns a set of 6, 9, 12 or 24 lobes.
const GaussianLobes& gaussianLobes(std::size_t count);

/// Spherical Gaussians: radiance of each lobe, [lobe][channel], >= 0.
Encoding sphericalGaussiansEncoding(std::size_t count);

}  // namespace prelight
