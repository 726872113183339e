#pragma once

#include "projectors/technique.h"

namespace prelight {

/// Horizons in sectors of azimuth around vertices.
Technique horizonsTechnique();

}  // namespace prelight
