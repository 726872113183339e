#pragma once

#include "prelight/plan.h"
#include "projectors/planning.h"
#include "scene/instancing.h"

namespace prelight {

/// Sets what a bake takes besides what techniques add for themselves: the scene, its trees, what receivers
/// see and the fits. Stored transport gets what BakeRequest::maxMemory leaves, but never less than a little;
/// the rest of it goes through a file. `plan` holds what techniques have added.
void estimateMemory(const PlanInput& input, const Instancing& instancing, Plan& plan);

}  // namespace prelight
