#pragma once

#include <functional>

#include "library/open_scene.h"
#include "prelight/device.h"
#include "prelight/refine.h"

namespace prelight {

/// Does refine() in steps of a call that goes on. `device` is called at most once, and not at all if nothing
/// is asked for. The scene is freed before the refined one is opened.
RefinedScene refineScene(LoadedScene scene, const RefineRequest& request,
                         const std::function<const Device&()>& device, Steps& steps);

/// Does unwrap() for a size in range, in steps of a call that goes on.
LoadedScene unwrapScene(LoadedScene scene, int size, Steps& steps);

}  // namespace prelight
