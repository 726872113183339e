#pragma once

#include "projectors/technique.h"

namespace prelight {

/// Diffuse transfer in cpherical harmonics.
Technique chTechnique();

}  // namespace prelight
