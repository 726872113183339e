#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

/// A part of a sky as a light at infinity.
struct SkyLight {
  glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit, towards the light
  glm::dvec3 irradiance{0.0};           ///< on a surface that faces it: the part's integral of radiance, W/m2
};

/// Returns a sky as at most `count` >= 1 lights (Debevec 2005, "A Median Cut Algorithm for Light Probe
/// Sampling"): the part with the widest spread of energy is cut into two of equal energy along its longer
/// side, until there are enough. Each light is at the centre of its part's energy. The lights' irradiances
/// add up to the sky's integral. Returns none for a black sky.
std::vector<SkyLight> medianCut(const Environment& sky, int count);

}  // namespace prelight
