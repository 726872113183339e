#pragma once

#include "techniques/technique.h"

namespace prelight {

/// What every vertex sees of each object.
Technique vectorOccludersTechnique();

}  // namespace prelight
