#pragma once

#include "projectors/technique.h"

namespace prelight {

/// Irradiance of the scene's static lights at vertices, whoever made it.
Technique radiosityTechnique();

}  // namespace prelight
