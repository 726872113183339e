#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Cones of what is open about bent normals.
Technique occlusionConesTechnique();

/// How it is drawn.
extern const ShadingInfo conesShading;

}  // namespace prelight
