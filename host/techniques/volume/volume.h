#pragma once

#include "techniques/technique.h"

namespace prelight {

/// SH transfer of points in the air.
Technique volumeTechnique();

/// How its transfer is lit on a device.
extern const Relighting volumeRelighting;

}  // namespace prelight
