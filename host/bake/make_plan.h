#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "prelight/scene.h"

namespace prelight {

/// Decides what a bake does. The plan of a scene without triangles runs nothing. Throws UsageError for
/// requests that checkRequest() refuses and for shadow sets that name no node of the scene; throws nothing
/// else.
Plan makePlan(const Scene& scene, const CompiledScene& compiled, const BakeRequest& request);

/// Which indirect ways of the sky's light a plan runs.
struct CarriedLight {
  bool bounces = false;
  bool specular = false;
  bool subsurface = false;
};

CarriedLight lightOf(const Plan& plan);

/// Returns a request in which techniques have chosen, for this scene, what it leaves to the plan.
BakeRequest withChoices(BakeRequest request, const CompiledScene& scene);

/// Returns the request as it is carried out: kinds of light that the plan skips are removed, so that what
/// only they need is skipped too.
BakeRequest carriedOut(BakeRequest request, const CarriedLight& light);

}  // namespace prelight
