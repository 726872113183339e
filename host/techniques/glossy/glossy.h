#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Transfer matrices of glossy surfaces.
Technique glossyTechnique();

/// How it is drawn.
extern const ShadingInfo glossyShading;

}  // namespace prelight
