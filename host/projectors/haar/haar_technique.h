#pragma once

#include "projectors/technique.h"

namespace prelight {

/// Diffuse transfer in Haar wavelets.
Technique haarTechnique();

}  // namespace prelight
