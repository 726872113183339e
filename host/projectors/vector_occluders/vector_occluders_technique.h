#pragma once

#include "projectors/technique.h"

namespace prelight {

/// What every vertex sees of each object.
Technique vectorOccludersTechnique();

}  // namespace prelight
