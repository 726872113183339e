#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// Guides of a denoiser: the first surface that the camera sees, directly or in mirrors and through glass.
struct Guides {
  std::vector<glm::vec3> albedo;  ///< [pixel] in [0,1]
  std::vector<glm::vec3> normal;  ///< [pixel] world space, mean of unit vectors; 0 where there is no surface
  bool noisy = true;              ///< true where mirrors, glass or few samples leave noise in the guides
};

}  // namespace prelight
