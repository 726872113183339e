#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Diffuse transfer in Haar wavelets.
Technique haarTechnique();

/// How it is drawn.
extern const ShadingInfo haarShading;

}  // namespace prelight
