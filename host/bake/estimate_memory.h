#pragma once

#include "prelight/plan.h"
#include "scene/instancing.h"
#include "techniques/technique.h"

namespace prelight {

/// Adds to the plan the memory that a bake takes besides what techniques have added for themselves: the
/// scene, its trees, receiver records and fits. Stored transport gets what BakeRequest::maxMemory leaves, but
/// at least a small minimum; what does not fit goes through a file.
void estimateMemory(const PlanInput& input, const Instancing& instancing, Plan& plan);

}  // namespace prelight
