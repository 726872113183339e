#pragma once

#include <optional>
#include <vector>

#include "device/build_options.h"
#include "gpu/shade_features.h"
#include "integrators/reference.h"
#include "prelight/plan.h"

namespace prelight::reference {

/// Returns the kernel features of a picture as passes with reasons.
std::vector<PlannedPass> explainFeatures(const ShadeFeatures& features, const ReferenceRequest& request);

/// Returns the build options of kernels/integrate, added to those of the scene. `cachedLight` is
/// CachedLight::meetsLights, or none without cached light.
BuildOptions buildOptions(const ReferenceRequest& request, std::optional<bool> cachedLight,
                          BuildOptions sceneOptions);

}  // namespace prelight::reference
