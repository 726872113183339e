#pragma once

#include "pictures/picture_request.h"
#include "pictures/shaded_scene.h"

namespace prelight::pictures {

/// Returns what lights a picture of a scene as it was asked for. `turn`: of the sky about +Y, radians.
viewer::LightOfPicture lightOfPicture(const PictureRequest& asked, const LoadedScene& loaded,
                                      const Environment* sky, double turn);

/// Chooses the shading of a picture that none is asked for: that of least expected error among those that the
/// bake carries; without a bake all light where the scene is of moderate size and a device traces it, else
/// direct light. `window`: what moves is followed.
viewer::Shading chooseShading(DrawingSession& session, const PictureRequest& asked, bool window,
                              const LoadedScene& loaded, const Bake& bake,
                              const viewer::LightOfPicture& light);

/// Throws UsageError where light that is followed or baked under the picture's lights would have to know area
/// lights or cookies. `everyShading`: of a window.
void checkAreaLights(const PictureRequest& asked, viewer::Shading shading, bool everyShading,
                     const Bake& bake);

/// Warns of options that mean nothing in the shading of `shaded`. Throws UsageError for light groups that it
/// lacks. `window`: lights can be dimmed there.
void checkShadingOptions(DrawingSession& session, const PictureRequest& asked, bool window,
                         const ShadedScene& shaded);

}  // namespace prelight::pictures
