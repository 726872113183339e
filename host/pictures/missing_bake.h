#pragma once

#include "pictures/picture_request.h"
#include "pictures/shaded_scene.h"

namespace prelight::pictures {

/// Bakes what the shading of `shaded` needs and its bake does not hold, saying so. With `everyShading` also
/// what ao and sh shading need and what else is asked for. Radiosity and light maps are baked under the
/// lights and the sky of the picture.
void bakeMissing(DrawingSession& session, const PictureRequest& asked, bool everyShading,
                 ShadedScene& shaded);

}  // namespace prelight::pictures
