#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Irradiance of the scene's static lights at vertices, whoever made it.
Technique radiosityTechnique();

/// How it is drawn.
extern const ShadingInfo radiosityShading;

}  // namespace prelight
