#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Irradiance of the scene's static lights, texel by texel. Its part of a primitive's entry names a picture
/// beside the file, so that embedLightMap writes it when that has a name.
Technique lightMapTechnique();

/// How it is drawn.
extern const ShadingInfo lightMapShading;

}  // namespace prelight
