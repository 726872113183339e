#pragma once

#include <filesystem>
#include <optional>

#include "pictures/picture_sky.h"
#include "prelight/bake.h"

namespace prelight::pictures {

/// The sky that a file's light was baked under: a built-in one, or the file that the record names, beside the
/// baked file, too, where it is the same picture. A sky that is not found is warned of. Nothing where the
/// file records none.
std::optional<PictureSky> bakedSkyOf(DrawingSession& session, const OpenedScene& loaded);

/// Warns where a picture shows another sky than the one that its light was baked under. `rotation`: radians,
/// of the picture's.
void warnOfOtherSky(DrawingSession& session, const OpenedScene& loaded, const Environment& sky,
                    double rotation);

}  // namespace prelight::pictures
