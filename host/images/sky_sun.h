#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "prelight/picture.h"

namespace prelight {

/// The sun of a sky, or any small disk that emits much of the sky's light.
struct SkySun {
  glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit, towards the sun
  double radius = 0.0;                  ///< angular radius of the disk, rad
  glm::dvec3 irradiance{0.0};           ///< on a surface that faces the sun, W/m2
};

/// A sky split in two parts whose light adds up to that of the whole.
struct SunAndSky {
  SkySun sun;
  Environment rest;
};

/// Separates the sun from a sky: the radiance within a few degrees of the brightest texel that exceeds the
/// mean of the surroundings. Returns nothing if that is less than a tenth of the sky's light or not a small
/// disk.
std::optional<SunAndSky> takeSunOut(const Environment& sky);

}  // namespace prelight
