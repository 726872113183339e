#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Light on the other side of surfaces that let light through.
Technique subsurfaceTechnique();

/// How pictures show it along with their shading.
extern const BakedPart otherSidesPart;

}  // namespace prelight
