#pragma once

#include "prelight/techniques.h"

namespace prelight {

/// Throws UsageError for a request with a number out of range (prelight/options.h) or with contradictory
/// numbers. It is cheap and runs before anything is allocated or compiled.
void checkRequest(const BakeRequest& request);

/// Throws UsageError for an option of a request that has no effect, because the technique it belongs to is
/// not requested.
void requireUse(const BakeRequest& request);

}  // namespace prelight
