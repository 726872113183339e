#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Ambient occlusion and bent normals.
Technique ambientOcclusionTechnique();

/// How it is drawn.
extern const ShadingInfo aoShading;

}  // namespace prelight
