#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Horizons in sectors of azimuth around vertices.
Technique horizonsTechnique();

/// How it is drawn.
extern const ShadingInfo horizonsShading;

}  // namespace prelight
