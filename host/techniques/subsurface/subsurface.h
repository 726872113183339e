#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Light on the other side of surfaces that let light through.
Technique subsurfaceTechnique();

}  // namespace prelight
