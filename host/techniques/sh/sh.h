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

/// How its transfer is lit on a device.
extern const Relighting shRelighting;
/// How its transfer at the keys of an animation is lit there.
extern const Relighting animationRelighting;

}  // namespace prelight
