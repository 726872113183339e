#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Diffuse transfer in Haar wavelets.
Technique haarTechnique();

/// How it is drawn.
extern const ShadingInfo haarShading;

/// How its transfer is lit on a device.
extern const Relighting haarRelighting;

}  // namespace prelight
