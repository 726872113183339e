#pragma once

#include "prelight/picture.h"

namespace prelight {

/// A cloudless day by the model of Preetham, Shirley and Smits (1999).
struct DaySky {
  double turbidity = 3.0;     ///< haze of the air: 2 is clear, 10 hazy
  double elevation = 0.8;     ///< angle of the sun above the horizon, rad, 0 to pi/2
  double azimuth = 0.0;       ///< direction of the sun, rad: from -Z towards +X
  double groundAlbedo = 0.2;  ///< albedo of the uniform ground below the horizon
  bool sun = false;           ///< whether the sun's disk is added to the sky
};

/// Returns the map of a day. Radiance 1 is a luminance of 1000 cd/m2. Throws UsageError for numbers out of
/// range.
Environment daySky(const DaySky& day);

}  // namespace prelight
