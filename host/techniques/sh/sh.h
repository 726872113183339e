#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Diffuse transfer in spherical harmonics.
Technique shTechnique();

/// The same, compressed.
Technique compressedShTechnique();

/// The same at moments of an animation.
Technique animationTechnique();

/// How it is drawn.
extern const ShadingInfo shShading;

}  // namespace prelight
