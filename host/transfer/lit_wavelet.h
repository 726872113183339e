#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace prelight {

/// A selected wavelet coefficient of a light, with a value per colour.
struct LitWavelet {
  std::uint32_t index = 0;  ///< below 6 faceSize^2
  glm::vec3 color{0.0f};
};

}  // namespace prelight
