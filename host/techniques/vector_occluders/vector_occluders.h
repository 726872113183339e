#pragma once

#include "techniques/technique.h"

namespace prelight {

/// What every vertex sees of each object.
Technique vectorOccludersTechnique();

/// How it is drawn.
extern const ShadingInfo occluderShading;

/// How its transfer is lit on a device.
extern const Relighting vectorOccludersRelighting;

}  // namespace prelight
