#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "prelight/scene.h"

namespace prelight {

/// Decides what a bake does. A scene without triangles gives a plan that runs nothing. Throws UsageError for
/// a shadow set that names no node of the scene, and nothing else.
Plan makePlan(const Scene& scene, const CompiledScene& compiled, const BakeRequest& request);

/// A request as it is carried out: without bounces or specular transport where the plan leaves them out, for
/// what only these need is left out with them.
BakeRequest carriedOut(BakeRequest request, bool bounces, bool specular);

}  // namespace prelight
