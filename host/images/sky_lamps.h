#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "prelight/picture.h"

namespace prelight {

/// A sun, a lamp or another bright and round place of a sky.
struct SkyLamp {
  glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit, towards the lamp
  double radius = 0.0;                  ///< angular radius of a disk as spread out as the lamp, rad
  glm::dvec3 irradiance{0.0};           ///< on a surface that faces the lamp, W/m2
};

/// A sky in two parts whose light adds up to that of the whole.
struct LampsAndSky {
  std::vector<SkyLamp> lamps;  ///< six at most
  Environment rest;  ///< at most 1024 texels wide
};

/// Separates lamps from a sky, as few bands of spherical harmonics hold them badly. A lamp is the radiance
/// within 2.5, 5 or 10 degrees of a bright place that exceeds the mean of the surroundings, if that is a
/// thirtieth of the sky's light and no more spread out than a disk of 9 degrees. A place is bright where a
/// texel is 5 times as bright as the sky's mean; a larger reach is taken where it adds 15 % of the light. The
/// 48 brightest places are tried.
LampsAndSky takeLampsOut(const Environment& sky);

}  // namespace prelight
