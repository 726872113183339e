#pragma once

#include "prelight/request.h"

namespace prelight {

/// Throws UsageError for a request with a number out of its range (prelight/parameters.h) or with numbers
/// that exclude each other. Costs nothing, and comes before anything is allocated or compiled.
void checkRequest(const BakeRequest& request);

/// Throws UsageError for a part of a request that means nothing, as what it is a part of is not asked for.
void requireUse(const BakeRequest& request);

}  // namespace prelight
