#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Diffuse transfer in cpherical harmonics.
Technique chTechnique();

/// How it is drawn.
extern const ShadingInfo chShading;

/// How its transfer is lit on a device.
extern const Relighting chRelighting;

}  // namespace prelight
