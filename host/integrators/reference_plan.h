#pragma once

#include <optional>
#include <vector>

#include "device/build_options.h"
#include "gpu/shade_features.h"
#include "integrators/reference.h"
#include "prelight/plan.h"

namespace prelight::reference {

/// What a picture needs of its kernels, for people, with reasons.
std::vector<PlannedPass> explainFeatures(const ShadeFeatures& features, const ReferenceRequest& request);

/// Build options of kernels/integrate, added to those of the scene.
/// `cachedLight`: there is some; CachedLight::meetsLights.
BuildOptions buildOptions(const ReferenceRequest& request, std::optional<bool> cachedLight,
                          BuildOptions sceneOptions);

}  // namespace prelight::reference
