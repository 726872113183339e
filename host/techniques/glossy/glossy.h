#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Transfer matrices of glossy surfaces.
Technique glossyTechnique();

}  // namespace prelight
