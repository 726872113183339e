#pragma once

#include "prelight/compiled_scene.h"
#include "prelight/plan.h"
#include "prelight/scene.h"

namespace prelight {

/// Decides what a bake does. A scene without triangles gives a plan that runs nothing. Throws UsageError for
/// what checkRequest() refuses and for a shadow set that names no node of the scene, and nothing else.
Plan makePlan(const Scene& scene, const CompiledScene& compiled, const BakeRequest& request);

/// What a plan runs of light that does not come straight from the sky.
struct CarriedLight {
  bool bounces = false;
  bool specular = false;
  bool subsurface = false;
};

CarriedLight lightOf(const Plan& plan);

/// A request as it is carried out: without the light that the plan leaves out, for what only this needs is
/// left out with it.
BakeRequest carriedOut(BakeRequest request, const CarriedLight& light);

}  // namespace prelight
