#pragma once

#include "pictures/picture_request.h"
#include "pictures/shaded_scene.h"

namespace prelight::pictures {

/// Throws UsageError where light that is followed or baked under the picture's lights would have to know area
/// lights or cookies. `everyShading`: of a window.
void checkAreaLights(const PictureRequest& asked, viewer::Shading shading, bool everyShading,
                     const Bake& bake);

/// Warns of options that mean nothing in the shading of `shaded`. Throws UsageError for light groups that it
/// lacks. `window`: lights can be dimmed there.
void checkShadingOptions(DrawingSession& session, const PictureRequest& asked, bool window,
                         const ShadedScene& shaded);

}  // namespace prelight::pictures
