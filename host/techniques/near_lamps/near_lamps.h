#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Shells of distance that shadow lamps within the scene.
Technique nearLampsTechnique();

}  // namespace prelight
