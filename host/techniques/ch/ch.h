#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Diffuse transfer in cpherical harmonics.
Technique chTechnique();

}  // namespace prelight
