#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Shells of distance that shadow lamps within the scene.
Technique nearLampsTechnique();

/// How pictures show it along with their shading.
extern const BakedPart shellPart;

}  // namespace prelight
