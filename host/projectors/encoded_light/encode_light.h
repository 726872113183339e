#pragma once

#include "base/progress.h"
#include "plan/plan.h"
#include "receivers/fit_mesh.h"
#include "scene/compiled_scene.h"
#include "transfer/bake.h"

namespace prelight {

/// Stores what arrives at the texels of the bake's light map, and at vertices between which it is nearest to
/// that when it is interpolated, in the encodings that are asked for: fills Bake::encodedLight and
/// LightMap::encoded. The map has incidentOrder before and the coefficients that the plan keeps afterwards.
/// Throws Interrupted.
void encodeLight(const CompiledScene& scene, const FitMesh& mesh, const EncodedLightRequest& request,
                 const Plan& plan, const Progress& progress, Bake& bake);

}  // namespace prelight
