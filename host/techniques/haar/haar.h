#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Diffuse transfer in Haar wavelets.
Technique haarTechnique();

}  // namespace prelight
