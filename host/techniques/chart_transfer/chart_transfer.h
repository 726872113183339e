#pragma once

#include "techniques/technique.h"

namespace prelight {

/// SH transfer of the texels of charts.
Technique chartTransferTechnique();

/// How pictures show it along with their shading.
extern const BakedPart chartPart;

/// How its transfer is lit on a device.
extern const Relighting texelRelighting;

}  // namespace prelight
