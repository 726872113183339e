#pragma once

#include "prelight/picture.h"

namespace prelight {

/// A day without clouds, as Preetham, Shirley and Smits (1999) have it.
struct DaySky {
  double turbidity = 3.0;     ///< of the air: 2 clear to 10 hazy
  double elevation = 0.8;     ///< of the sun above the horizon, rad, 0 to pi/2
  double azimuth = 0.0;       ///< of the sun, rad: from -Z towards +X
  double groundAlbedo = 0.2;  ///< of the even ground below the horizon
  bool sun = false;           ///< its own disk, too: else the sky alone
};

/// Its map; radiance 1 is a luminance of 1000 cd/m2. Throws UsageError for numbers beyond their ranges.
Environment daySky(const DaySky& day);

}  // namespace prelight
