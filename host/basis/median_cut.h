#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

/// A part of a sky as a light at infinity.
struct SkyLight {
  glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit, where it is seen
  glm::dvec3 irradiance{0.0};           ///< on a surface that faces it: the part's integral of radiance, W/m2
};

/// A sky as at most `count` >= 1 lights (Debevec 2005, "A Median Cut Algorithm for Light Probe Sampling"):
/// the part whose energy is spread widest is cut in two of equal energy along its longer side, until there
/// are enough. Each light stands where its part's energy is centred. The lights' irradiances add up to the
/// sky's integral. None for a black sky.
std::vector<SkyLight> medianCut(const Environment& sky, int count);

}  // namespace prelight
