#pragma once

#include "pictures/picture_request.h"
#include "pictures/picture_sky.h"
#include "prelight/bake.h"

namespace prelight::pictures {

/// Returns what lights a picture of a scene as it was asked for. `turn`: of the sky about +Y, radians.
viewer::LightOfPicture lightOfPicture(const PictureRequest& asked, const LoadedScene& loaded,
                                      const Environment* sky, double turn);

/// Chooses the shading of a picture that none is asked for: that of least expected error among those that the
/// bake carries; without a bake all light where lamps are within a scene of moderate size, else direct light.
viewer::Shading chooseShading(const PictureRequest& asked, const LoadedScene& loaded, const Bake& bake,
                              const viewer::LightOfPicture& light);

}  // namespace prelight::pictures
