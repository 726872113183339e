#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Thickness of bodies at vertices: how far light runs through them.
Technique thicknessTechnique();

/// Light that shines through bodies, by their thickness.
extern const ShadingInfo thicknessShading;

}  // namespace prelight
