#pragma once

#include "techniques/technique.h"

namespace prelight {

/// SH transfer of points in the air.
Technique volumeTechnique();

}  // namespace prelight
