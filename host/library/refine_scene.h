#pragma once

#include <functional>

#include "library/open_scene.h"
#include "prelight/device.h"
#include "prelight/refine.h"

namespace prelight {

/// Does refine() in steps of a call that goes on. `device` is called at most once, and not at all if nothing
/// is asked for.
RefinedScene refineScene(const LoadedScene& scene, const RefineRequest& request,
                         const std::function<const Device&()>& device, Steps& steps);

/// Does unwrap() in steps of a call that goes on.
LoadedScene unwrapScene(const LoadedScene& scene, int size, Steps& steps);

}  // namespace prelight
