#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Diffuse transfer in cpherical harmonics.
Technique chTechnique();

/// How it is drawn.
extern const ShadingInfo chShading;

}  // namespace prelight
