#pragma once

#include "techniques/technique.h"

namespace prelight {

/// What arrives on the other side of surfaces that let light through.
Technique subsurfaceTechnique();

}  // namespace prelight
