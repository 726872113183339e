#pragma once

#include "pictures/picture_request.h"
#include "pictures/shaded_scene.h"

namespace prelight::pictures {

/// Warns of triangles that are too large for a shading whose values lie at vertices, unless the scene was
/// refined.
void warnOfCoarseTriangles(DrawingSession& session, const PictureRequest& asked, const ShadedScene& shaded);

/// Bakes what the shading of `shaded` needs and its bake does not hold, saying so. With `everyShading` also
/// what ao and sh shading need and what else is asked for. Radiosity and light maps are baked under the
/// lights and the sky of the picture.
void bakeMissing(DrawingSession& session, const PictureRequest& asked, bool everyShading,
                 ShadedScene& shaded);

/// Refines a scene as asked, and gives it charts for texels that are asked for, before it is baked. A scene
/// whose file carries a bake stays.
void refineAsAsked(DrawingSession& session, const PictureRequest& asked, const Bake& carried,
                   LoadedScene& loaded);

}  // namespace prelight::pictures
