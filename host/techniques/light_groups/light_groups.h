#pragma once

#include "techniques/technique.h"

namespace prelight {

/// Light of the scene's own emitters, group by group.
Technique lightGroupsTechnique();

/// How it is drawn.
extern const ShadingInfo lightsShading;

/// How its transfer is lit on a device.
extern const Relighting lightGroupsRelighting;

}  // namespace prelight
