#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Horizons in sectors of azimuth around vertices.
Technique horizonsTechnique();

}  // namespace prelight
