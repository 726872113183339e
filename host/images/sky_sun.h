#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "prelight/picture.h"

namespace prelight {

/// The sun of a sky, or what shines like one: a small disk that sends much of the sky's light.
struct SkySun {
  glm::dvec3 direction{0.0, 1.0, 0.0};  ///< towards it, unit
  double radius = 0.0;                  ///< half the angle of its disk, rad
  glm::dvec3 irradiance{0.0};           ///< of a surface that faces it, W/m2
};

/// A sky in two parts, whose light adds up to that of the whole.
struct SunAndSky {
  SkySun sun;
  Environment rest;
};

/// Takes the sun out of a sky: what is brighter, within a few degrees of the brightest texel, than the mean
/// of what surrounds them. Nothing where that is less than a tenth of the sky's light, or no small disk.
std::optional<SunAndSky> takeSunOut(const Environment& sky);

}  // namespace prelight
