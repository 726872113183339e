#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace prelight {

/// What tells a denoiser of a picture where things end: of the first surface that the camera sees, or sees
/// in mirrors and through glass.
struct Guides {
  std::vector<glm::vec3> albedo;  ///< [pixel] in [0,1]
  std::vector<glm::vec3> normal;  ///< [pixel] world, mean of unit vectors; 0: nothing is there
  bool noisy = true;              ///< by chance at mirrors and glass, or as they are of few samples
};

}  // namespace prelight
