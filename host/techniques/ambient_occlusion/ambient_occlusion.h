#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Ambient occlusion and bent normals.
Technique ambientOcclusionTechnique();

}  // namespace prelight
