#pragma once

#include "prelight/request.h"

namespace prelight {

/// Bands of SH that bounces carry, for every technique that has them: 0 when only AO or lights are asked for.
int transferOrder(const BakeRequest& request);

/// Bands of SH that rays are projected to.
int castOrder(const BakeRequest& request);

}  // namespace prelight
