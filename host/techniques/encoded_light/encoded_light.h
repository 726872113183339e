#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Light that arrives at vertices, in encodings. That of texels is in the light map's picture.
Technique encodedLightTechnique();

/// How pictures show it along with their shading.
extern const BakedPart encodingPart;

}  // namespace prelight
