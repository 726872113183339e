#pragma once

#include "prelight/techniques.h"

namespace prelight {

/// Returns the bands of SH that bounces carry for all techniques, 0 if only AO or lights are requested.
int transferOrder(const BakeRequest& request);

/// Returns the bands of SH for shadows of lamps within the scene: those of SH or CH transfer, or usual ones
/// beside Haar and glossy transfer, 0 if none of these is requested.
int nearLampOrder(const BakeRequest& request);

/// Returns the bands of SH that rays are projected to.
int castOrder(const BakeRequest& request);

/// Throws UsageError about `field`, whose order is that of SH, if no SH is requested.
void requireShOrder(const BakeRequest& request, const char* field);

}  // namespace prelight
