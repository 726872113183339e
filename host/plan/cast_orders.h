#pragma once

#include "prelight/request.h"

namespace prelight {

/// Bands of SH that bounces carry, for every technique that has them: 0 when only AO or lights are asked for.
int transferOrder(const BakeRequest& request);

/// Bands of SH of what shadows lamps within the scene: those of SH or CH transfer; 0: neither is asked for.
int nearLampOrder(const BakeRequest& request);

/// Bands of SH that rays are projected to.
int castOrder(const BakeRequest& request);

/// Throws UsageError about `field` where no SH is asked for, whose order it has.
void requireShOrder(const BakeRequest& request, const char* field);

}  // namespace prelight
