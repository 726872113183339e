#pragma once

#include "projectors/technique.h"

namespace prelight {

/// Transfer matrices of glossy surfaces.
Technique glossyTechnique();

}  // namespace prelight
